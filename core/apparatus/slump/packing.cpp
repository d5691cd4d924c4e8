#include "core/apparatus/slump/packing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/apparatus/slump/random_addition.h"
#include "core/apparatus/specimen.h"
#include "core/laws/constants.h"
#include "core/observe/heap.h"
#include "core/step/runner.h"

namespace pastefit {

namespace {

// Size of a grain before growth over its final size: small enough for random, even placement without a column high
// above the mould.
constexpr double kStartSize = 0.7;
constexpr double kLoosest = 0.55;      // solid fraction after growth, before sinking
constexpr double kGrowthSpeed = 0.04;  // [m/s] of a grain's surface; also the limit of the sinking speed during growth
constexpr int kGrowthSteps = 20;
constexpr double kOverfill = 1.12;  // solid volume of all grains over that of a mould at kSolidFraction
constexpr double kSolidFraction = 0.62;
constexpr double kHighestThrow = 1;  // [m]; growth throws even the stiffest grain less high
constexpr double kLidSpeed = 0.2;    // [m/s]
constexpr double kFillCap = 4.0;     // [s]
constexpr double kScoopSpeed = 1.0;  // [m/s] sinking speed of grains
constexpr double kGentle = 0.2;      // deepest overlap of a falling grain over its radius
constexpr double kDeepest = 0.9;     // overlap over the smaller radius, of a small grain between growing large ones
constexpr double kEmptiest = 0.45;   // least solid fraction; less means a hole in the fill
// Grains are struck off while they still oscillate a little, and pressed level likewise: the rest decays when the
// column comes to rest under the candidate's laws.
constexpr RestCriterion kLanded{.window_s = 0.02, .windows = 1, .speed_over_fall = 0.15, .change_over_radius = 0.1};
// A longer step than in a test: drag absorbs the energy it may create, and only positions are used.
constexpr double kSafety = 0.95;
constexpr double kImpactResolution = 6;

// Frictions, and steps of the resting overlap, at which moulds are filled; candidates in between share a fill.
constexpr double kFrictions[] = {0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5};
constexpr double kRestingOverlapStep = 0.005;
// [radii] Grains with their centre less than this below the rim are removed. With a smaller value the lid presses so
// hard that the column rises by 1 % when it is removed.
constexpr double kScrape = 0.7;

/// Solid volume of the grains that fill mould and hopper.
double drawn_volume(const Mould& mould) {
  return kOverfill * kSolidFraction * volume_m3(mould);
}

/// Draws grains of the test until they have this solid volume.
void draw_grains(const SlumpTest& test, double solid_volume, Packing& packing) {
  while (packing.solid_volume_m3 < solid_volume) {
    packing.radii.push_back(draw_radius(test.grains, test.packing_seed, packing.radii.size()));
    packing.solid_volume_m3 += sphere_volume_m3(packing.radii.back());
  }
}

/// Frictional grains without cohesion, so that candidates can share the fill; or the test's own model.
ContactModel filling_model(const SlumpTest& test, const RunOptions& options) {
  if (options.own_fill) return test.contact;
  ContactModel model;
  model.youngs_modulus_pa = filling_of(test).youngs_modulus_pa;
  model.poissons_ratio = 0.3;
  model.restitution = 0.2;
  model.friction = filling_of(test).friction;
  model.rolling = RollingModel::none;
  return model;
}

Wall make_wall(std::string name, Shape shape, const SlumpTest& test, const RunOptions& options) {
  // Smooth: friction at a wall would carry the fill, which would sink when the test's own wall replaces it.
  const WallContact shared{1e9, 0.3, 0.2, 0, 0, 0};
  const WallContact& of_test = name == "floor" ? test.table_wall : test.mould_wall;
  Wall wall;
  wall.name = std::move(name);
  wall.shape = shape;
  wall.pair = wall_pair(filling_model(test, options), options.own_fill ? of_test : shared, test.grains.radius_m);
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
    packing.solid_volume_m3 += sphere_volume_m3(packing.radii[i]);
  }
}

double highest(const Packing& packing) {
  double top = 0;
  for (std::size_t i = 0; i < packing.centres.size(); ++i) top = std::max(top, packing.centres[i].z + packing.radii[i]);
  return top;
}

/// Mould, floor and a hopper as wide as the mould's top, high enough to catch every grain.
World filling_world(const SlumpTest& test, const RunOptions& options, const Packing& packing) {
  const Mould& mould = test.mould;
  World world;
  world.particles = make_particles(packing.centres, packing.radii, test.bulk_density_kg_m3 / kSolidFraction);
  set_contact_model(world, filling_model(test, options), test.grains.radius_m);
  const double hopper = std::max(highest(packing) - mould.height_m, 0.0) + kHighestThrow;
  world.walls = {make_wall("floor", Plane{}, test, options),
                 make_wall("mould", Shell{{}, mould.base_radius_m, mould.top_radius_m, mould.height_m}, test, options),
                 make_wall("hopper", Shell{{0, 0, mould.height_m}, mould.top_radius_m, mould.top_radius_m, hopper},
                           test, options)};
  return world;
}

void take_work(Packing& packing, const RunSummary& run) {
  packing.run.particles = run.particles;
  packing.run.settled = run.settled;
  packing.run.steps += run.steps;
  packing.run.particle_steps += run.particle_steps;
  packing.run.simulated_s += run.simulated_s;
}

/// Sinking speed of grains: that of a scoop, but limited so that a grain that hits a plane of its own kind overlaps by
/// at most `kGentle` of its radius (Hertz; independent of size).
double sinking_speed(const World& world) {
  const double modulus = 0.5 * world.grain_pair.normal_stiffness;
  const double harmless =
      std::sqrt(std::pow(kGentle, 2.5) * 0.8 / std::numbers::pi * modulus / world.particles.density_kg_m3);
  return std::min(kScoopSpeed, harmless);
}

/// The fill is at rest when its height and width no longer change; single grains may still roll on top.
std::vector<double> rest_measure_of_fill(const Particles& grains) {
  auto lengths = rest_measure_of_heap(grains);
  lengths.erase(lengths.begin());  // the highest point
  return lengths;
}

/// Growth time relative to equal grains: small grains between large ones have to find their way out.
double patience_with(const GrainSizes& sizes) {
  constexpr double even = 3;
  if (sizes.distribution == SizeDistribution::mono) return 1;
  return std::max(1.0, sizes.largest_m / sizes.smallest_m / even);
}

/// Small grains at random places grow to full size until they fill mould and hopper loosely. They form no layers,
/// unlike grains let down from a lattice. Their mass is always that of the grown grain.
std::optional<Failure> grow(const SlumpTest& test, World& world, Runner& runner) {
  const double step =
      (1 - kStartSize) * test.grains.radius_m / kGrowthSpeed / kGrowthSteps * patience_with(test.grains);
  world.drag = kGravity / kGrowthSpeed;
  double size = kStartSize;
  for (auto& grain : world.particles.motion) grain.radius *= size;
  for (int i = 1; i <= kGrowthSteps; ++i) {
    const double next = kStartSize + (1 - kStartSize) * i / kGrowthSteps;
    for (auto& grain : world.particles.motion) grain.radius *= next / size;
    size = next;
    runner.changed();
    const double left = step * (kGrowthSteps - i);
    if (auto problem = runner.run({.name = "fill.grow", .after = {left, left}}, i * step - world.time)) return problem;
  }
  return {};
}

/// Lets the grains sink as in a liquid. A free fall crushes soft grains and packs to 0.62 instead of 0.59; a weak paste
/// is then 20 mm lower after lifting.
void let_sink(const SlumpTest& test, const RunOptions& options, Packing& packing) {
  std::vector<double> small = packing.radii;
  for (double& radius : small) radius *= kStartSize;
  packing.centres =
      random_addition(test.mould, small, kLoosest * kStartSize * kStartSize * kStartSize, test.packing_seed);
  World world = filling_world(test, options, packing);
  Runner runner(world, options, rest_measure_of_fill);
  packing.failure = grow(test, world, runner);
  world.drag = kGravity / sinking_speed(world);
  if (!packing.failure) packing.failure = runner.settle({"fill.sink"}, kFillCap);
  take_work(packing, runner.summary());
  take_grains(world, packing);
}

/// Removes what protrudes above the rim; a lid presses the rest level with it.
void strike_off(const SlumpTest& test, const RunOptions& options, Packing& packing) {
  const double rim = test.mould.height_m;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < packing.centres.size(); ++i) {
    if (packing.centres[i].z > rim - kScrape * packing.radii[i]) continue;
    packing.centres[kept] = packing.centres[i];
    packing.radii[kept++] = packing.radii[i];
  }
  packing.centres.resize(kept);
  packing.radii.resize(kept);

  const double top = std::max(highest(packing), rim);
  World world = filling_world(test, options, packing);
  world.walls.push_back(make_wall("lid", Plane{{0, 0, top}, {0, 0, -1}}, test, options));
  world.drag = kColumnDrag;
  Runner runner(world, options, rest_measure_of_heap);
  world.walls.back().velocity = {0, 0, -kLidSpeed};
  packing.failure = runner.run({"fill.strike"}, (top - rim) / kLidSpeed);
  if (!packing.failure) {
    world.walls.back().velocity = {};
    std::get<Plane>(world.walls.back().shape).point.z = rim;
    packing.failure = runner.settle({"fill.rest"}, kFillCap);
  }
  take_work(packing, runner.summary());
  take_grains(world, packing);
}

/// Large growing grains push small ones away: if sizes differ widely, the failure is attributed to that.
void blame_sizes(Packing& packing) {
  constexpr double wide = 3;
  if (!packing.failure || packing.failure->reason == FailureReason::stopped || packing.radii.empty()) return;
  const auto [smallest, largest] = std::ranges::minmax(packing.radii);
  if (largest < wide * smallest) return;
  packing.failure->message += "; the mould is being filled with grains the largest of which is " +
                              std::to_string(std::lround(largest / smallest)) +
                              " times the smallest: take sizes nearer to each other, e.g. without the finest";
}

}  // namespace

double grains_needed(const SlumpTest& test) {
  constexpr int kDraws = 1000;
  double volume = 0;
  for (int n = 0; n < kDraws; ++n)
    volume += sphere_volume_m3(draw_radius(test.grains, test.packing_seed, static_cast<std::uint64_t>(n))) / kDraws;
  return drawn_volume(test.mould) / volume * std::pow(1 + filling_of(test).resting_overlap, 3);
}

double grain_density(const SlumpTest& test, const Packing& packing) {
  return test.bulk_density_kg_m3 * volume_m3(test.mould) / packing.solid_volume_m3;
}

Filling filling_of(const SlumpTest& test) {
  Filling filling;
  for (const double friction : kFrictions)
    if (friction <= test.contact.friction) filling.friction = friction;
  // Computed exactly: the last bits of exp2 differ between processors.
  const int half_octaves = static_cast<int>(std::lround(2 * std::log2(test.contact.youngs_modulus_pa)));
  const int octaves = half_octaves >= 0 ? half_octaves / 2 : (half_octaves - 1) / 2;
  filling.youngs_modulus_pa = std::ldexp(half_octaves == 2 * octaves ? 1.0 : std::numbers::sqrt2, octaves);
  filling.resting_overlap =
      kRestingOverlapStep * std::round(resting_overlap(test.contact, test.grains.radius_m) / kRestingOverlapStep);
  return filling;
}

std::shared_ptr<const Packing> fill_mould(const SlumpTest& test, const RunOptions& asked) {
  RunOptions options = asked;
  // The step and the energy balance apply to the test; the packing is always the same.
  options.steps.fixed_step_s.reset();
  options.steps.safety = kSafety;
  options.steps.impact_resolution = kImpactResolution;
  options.steps.energy_balance = false;
  options.rest = kLanded;
  options.steps.overlap_limit = std::max(options.steps.overlap_limit, kDeepest);
  const double swelling = options.own_fill ? 1 : 1 + filling_of(test).resting_overlap;
  SlumpTest smaller = test;
  smaller.grains = enlarged(test.grains, 1 / swelling);
  auto packing = std::make_shared<Packing>();
  draw_grains(smaller, drawn_volume(test.mould), *packing);
  let_sink(smaller, options, *packing);
  if (!packing->failure) strike_off(smaller, options, *packing);
  const double fraction = packing->solid_volume_m3 / volume_m3(test.mould);
  if (!packing->failure && fraction < kEmptiest)
    packing->failure = Failure{FailureReason::packing_failed,
                               "fill.rest",
                               packing->run.steps,
                               packing->run.simulated_s,
                               -1,
                               fraction,
                               kEmptiest,
                               "the grains bridge in the mould and leave it partly empty; take smaller grains"};
  blame_sizes(*packing);
  const Fit fit = fit_of(test.mould, make_particles(packing->centres, packing->radii, 1), smaller.grains.radius_m);
  packing->roughness_m = fit.roughness_m;
  packing->gap_m = fit.gap_m;
  for (double& r : packing->radii) r *= swelling;
  packing->solid_volume_m3 *= swelling * swelling * swelling;
  return packing;
}

namespace {

constexpr double kGroundDepth = 0.1;  // [m] below the table

}  // namespace

Shape table_on_seat(const SlumpTest& test) {
  // A shell of zero height from the edge to the axis.
  if (test.drop && test.drop->motion == TableMotion::vertical) return Shell{{}, 0.5 * test.drop->length_m, 0, 0};
  Plate plate;
  plate.half_length = plate.half_width = 0.5 * (test.drop ? test.drop->length_m : test.table_length_m);
  return plate;
}

World world_in_mould(const SlumpTest& test, const Packing& packing) {
  World world;
  world.particles = make_particles(packing.centres, packing.radii, grain_density(test, packing));
  set_contact_model(world, test.contact, test.grains.radius_m);
  const auto add = [&](const char* name, Shape shape, const WallContact& surface) {
    Wall wall;
    wall.name = name;
    wall.shape = shape;
    wall.pair = wall_pair(test.contact, surface, test.grains.radius_m);
    world.walls.push_back(wall);
  };
  const Mould& mould = test.mould;
  add("table", table_on_seat(test), test.table_wall);
  add("ground", Plane{{0, 0, -kGroundDepth}}, test.table_wall);
  world.walls[kGround].pair.rolling_friction = 1;
  add("mould", Shell{{}, mould.base_radius_m, mould.top_radius_m, mould.height_m}, test.mould_wall);
  return world;
}

}  // namespace pastefit
