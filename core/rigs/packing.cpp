#include "core/rigs/packing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "core/step/runner.h"

namespace pastefit {

namespace {

constexpr double kLoosest = 2.15;   // spacing of the starting lattice over the largest radius
constexpr double kOverfill = 1.12;  // solid volume poured over that of a mould packed to kSolidFraction
constexpr double kSolidFraction = 0.62;
constexpr double kPackingFriction = 0.5;  // a looser fill than a rodded one: a dense one is brittle (see README)
constexpr double kLidSpeed = 0.2;         // [m/s]
constexpr double kFillCap = 4.0;          // [s]

double sphere_volume(double r) {
  return 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

double largest_radius(const GrainSizes& sizes) {
  return sizes.distribution == SizeDistribution::mono ? sizes.radius_m : sizes.largest_m;
}

/// Inner radius at height z of the mould with a straight hopper on top of it.
double inner_radius(const Mould& mould, double z) {
  const double share = std::min(z / mould.height_m, 1.0);
  return mould.base_radius_m + share * (mould.top_radius_m - mould.base_radius_m);
}

/// Loose grains on a jittered lattice in mould and hopper, from the bottom up, until enough is poured.
void pour(const SlumpTable& test, Packing& packing) {
  const double largest = largest_radius(test.grains);
  const double spacing = kLoosest * largest;
  const double jitter = 0.5 * spacing - largest;
  const double enough = kOverfill * kSolidFraction * volume_m3(test.mould);
  const RandomStream place(test.packing_seed, "pour-position");
  const int across = static_cast<int>(test.mould.base_radius_m / spacing) + 1;
  std::uint64_t n = 0;
  for (int layer = 0; packing.solid_volume_m3 < enough; ++layer) {
    const double z = spacing * (layer + 0.5);
    const double room =
        std::min(inner_radius(test.mould, z - jitter), inner_radius(test.mould, z + jitter)) - 1.01 * largest;
    for (int iy = -across; iy <= across; ++iy)
      for (int ix = -across; ix <= across; ++ix) {
        if (packing.solid_volume_m3 >= enough) continue;
        const double shift = layer % 2 == 0 ? 0.0 : 0.5;
        const Vec3 p{spacing * (ix + shift) + place.uniform(3 * n, -jitter, jitter),
                     spacing * (iy + shift) + place.uniform(3 * n + 1, -jitter, jitter),
                     z + place.uniform(3 * n + 2, -jitter, jitter)};
        if (p.x * p.x + p.y * p.y > room * room) continue;
        const double r = draw_radius(test.grains, test.packing_seed, n);
        packing.centres.push_back(p);
        packing.radii.push_back(r);
        packing.solid_volume_m3 += sphere_volume(r);
        ++n;
      }
  }
}

/// Frictional grains without cohesion: the fill does not depend on what is calibrated.
ContactModel filling_model(const SlumpTable& test) {
  ContactModel model;
  model.youngs_modulus_pa = test.contact.youngs_modulus_pa;
  model.poissons_ratio = test.contact.poissons_ratio;
  model.restitution = 0.2;
  model.friction = kPackingFriction;
  model.rolling = RollingModel::none;
  return model;
}

Wall make_wall(std::string name, Shape shape, const ContactModel& model, const SlumpTable& test) {
  Wall wall;
  wall.name = std::move(name);
  wall.shape = shape;
  wall.pair = wall_pair(model, {1e9, 0.3, 0.2, kPackingFriction, 0, 0}, test.grains.radius_m);
  return wall;
}

void take_grains(const World& world, Packing& packing) {
  const std::int32_t n = world.particles.count();
  packing.centres.assign(n, {});
  packing.radii.assign(n, 0);
  packing.solid_volume_m3 = 0;
  // In spatial order, so that every run starts sorted.
  for (std::int32_t i = 0; i < n; ++i) {
    packing.centres[i] = world.particles.motion[i].position;
    packing.radii[i] = world.particles.motion[i].radius;
    packing.solid_volume_m3 += sphere_volume(packing.radii[i]);
  }
}

}  // namespace

double draw_radius(const GrainSizes& sizes, std::uint64_t seed, std::uint64_t n) {
  switch (sizes.distribution) {
    case SizeDistribution::mono:
      return sizes.radius_m;
    case SizeDistribution::uniform:
      return RandomStream(seed, "grain-radius").uniform(n, sizes.smallest_m, sizes.largest_m);
    case SizeDistribution::normal: {
      const RandomStream draws(seed, "grain-radius");
      constexpr std::uint64_t kTries = 1000;
      for (std::uint64_t t = 0; t < kTries; ++t) {
        const double r = sizes.radius_m + sizes.standard_deviation_m * draws.normal(kTries * n + t);
        if (r >= sizes.smallest_m && r <= sizes.largest_m) return r;
      }
      return std::clamp(sizes.radius_m, sizes.smallest_m, sizes.largest_m);
    }
  }
  return sizes.radius_m;
}

std::shared_ptr<const Packing> fill_mould(const SlumpTable& test, const RunOptions& asked) {
  RunOptions options = asked;
  options.time_step_s.reset();  // a fixed step is meant for the test; the fill is always run at its own
  auto packing = std::make_shared<Packing>();
  const Mould& mould = test.mould;
  pour(test, *packing);
  double top = 0;
  for (std::size_t i = 0; i < packing->centres.size(); ++i)
    top = std::max(top, packing->centres[i].z + packing->radii[i]);

  const ContactModel model = filling_model(test);
  const double density = test.bulk_density_kg_m3 / kSolidFraction;
  World world;
  world.particles = make_particles(packing->centres, packing->radii, density);
  set_contact_model(world, model, test.grains.radius_m);
  world.walls.push_back(make_wall("floor", Plane{}, model, test));
  world.walls.push_back(
      make_wall("mould", Shell{{}, mould.base_radius_m, mould.top_radius_m, mould.height_m}, model, test));
  const double hopper = std::max(top - mould.height_m, 0.0) + 2 * test.grains.radius_m;
  world.walls.push_back(
      make_wall("hopper", Shell{{0, 0, mould.height_m}, mould.top_radius_m, mould.top_radius_m, hopper}, model, test));

  const StepOptions steps;
  Runner pouring(world, options, steps);
  packing->failure = pouring.settle("fill.pour", kFillCap);
  packing->run = pouring.summary();
  if (packing->failure) return packing;

  // Strike off: what has its centre above the rim is scraped away, a lid presses the rest level with the rim.
  take_grains(world, *packing);
  std::vector<Vec3> centres;
  std::vector<double> radii;
  double highest = mould.height_m;
  for (std::size_t i = 0; i < packing->centres.size(); ++i) {
    if (packing->centres[i].z > mould.height_m) continue;
    centres.push_back(packing->centres[i]);
    radii.push_back(packing->radii[i]);
    highest = std::max(highest, centres.back().z + radii.back());
  }
  World struck;
  struck.particles = make_particles(centres, radii, density);
  set_contact_model(struck, model, test.grains.radius_m);
  for (Wall& wall : world.walls) struck.walls.push_back(make_wall(wall.name, wall.shape, model, test));
  struck.walls.push_back(make_wall("lid", Plane{{0, 0, highest}, {0, 0, -1}}, model, test));
  Runner striking(struck, options, steps);
  struck.walls.back().velocity = {0, 0, -kLidSpeed};
  const double stroke = highest - mould.height_m;
  packing->failure = striking.run("fill.strike", stroke / kLidSpeed);
  if (!packing->failure) {
    struck.walls.back().velocity = {};
    std::get<Plane>(struck.walls.back().shape).point.z = mould.height_m;
    packing->failure = striking.settle("fill.rest", kFillCap);
  }
  const double poured_s = packing->run.simulated_s;
  const std::int64_t poured_steps = packing->run.steps, poured_work = packing->run.particle_steps;
  packing->run = striking.summary();
  packing->run.simulated_s += poured_s;
  packing->run.steps += poured_steps;
  packing->run.particle_steps += poured_work;
  take_grains(struck, *packing);

  const double fraction = packing->solid_volume_m3 / volume_m3(mould);
  if (!packing->failure && fraction < 0.45)
    packing->failure = Failure{FailureReason::packing_failed,
                               "fill.rest",
                               struck.step,
                               struck.time,
                               -1,
                               fraction,
                               0.45,
                               "the grains bridge in the mould and leave it partly empty; take smaller grains"};
  return packing;
}

}  // namespace pastefit
