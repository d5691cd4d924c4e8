#include "core/world/domain.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/step/kernels.h"
#include "tests/core/scene.h"

namespace pastefit {
namespace {

constexpr double kSlice = 0.1;  // [m], ten radii of the grains of a Scene

ContactModel sticky_paste() {
  ContactModel model;
  model.bridge.shape = BridgeShape::linear;
  model.bridge.c_n = 0.02;
  model.bridge.d_c_m = -0.003;
  model.bridge.offset_m = 0.001;
  return model;
}

/// The same grains in a slice: what moves through the seam, and what lies across it.
Scene in_slice(const ContactModel& model, double period = kSlice) {
  Scene scene(model);
  scene.world.domain.period = period;
  return scene;
}

double apart_in_slice(const Vec3& a, const Vec3& b, double period) {
  return norm(Domain{period}.minimum_image(a, b));
}

/// So many grains in a slice of ten radii, on a lattice, moving this way and that.
void add_crowd(Scene& scene, int layers, double shift, int across = 4) {
  const RandomStream draws(7, "crowd");
  std::uint64_t n = 0;
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y < across; ++y)
      for (int x = 0; x < 4; ++x, n += 6) {
        const auto draw = [&](int k, double most) { return draws.uniform(n + k, -most, most); };
        scene.grain(
            {shift + 0.025 * (x + 0.5) + draw(0, 0.002), 0.025 * y + draw(1, 0.002), 0.025 * z + draw(2, 0.002)},
            {draw(3, 0.5), draw(4, 0.5), draw(5, 0.5)});
      }
}

TEST_CASE("the way between two grains of a slice is the shortest, whichever of their images is asked for") {
  const Domain slice{kSlice};
  CHECK(slice.minimum_image(Vec3{0.095, 0, 0}, Vec3{0.005, 0.01, 0}).x == Approx(0.01));
  CHECK(slice.minimum_image(Vec3{0.005, 0, 0}, Vec3{0.095, 0.01, 0}).x == Approx(-0.01));
  CHECK(slice.minimum_image(Vec3{-0.02, 0, 0}, Vec3{0.11, 0, 0}).x == Approx(0.03));
  CHECK(slice.put_back({0.27, 1, 2}).x == Approx(0.07));
  CHECK(slice.put_back({-0.27, 1, 2}).x == Approx(0.03));
  CHECK(slice.put_back({0.07, 1, 2}).x == 0.07);
  const Vec3 there{0.7, 0.2, 0.1}, here{0.1, 0, 0};
  CHECK(Domain{}.minimum_image(here, there).x == (there - here).x);
}

TEST_CASE("a grain that leaves a slice on one side hits one on the other, as two grains do that meet anywhere") {
  ContactModel model;
  model.restitution = 0.6;
  model.youngs_modulus_pa = 5e6;
  constexpr double speed = 0.5, step = 1e-5;
  Scene across = in_slice(model);
  across.grain({0.085, 0.03, 0}, {speed, 0, 0}).grain({0.012, 0.03, 0});
  across.run(0.05, step);
  const double first = across.velocity(0).x, second = across.velocity(1).x;
  CHECK(first == Approx(speed * (1 - 0.6) / 2).epsilon(0.01));
  CHECK(second == Approx(speed * (1 + 0.6) / 2).epsilon(0.01));
  CHECK(across.momentum().x == Approx(across.mass(0) * speed).epsilon(1e-12));

  Scene anywhere(model);
  anywhere.grain({0.085, 0.03, 0}, {speed, 0, 0}).grain({0.112, 0.03, 0});
  anywhere.run(0.05, step);
  CHECK(first == Approx(anywhere.velocity(0).x).epsilon(1e-9));
  CHECK(second == Approx(anywhere.velocity(1).x).epsilon(1e-9));
}

TEST_CASE("every pair of a slice is listed once, however few cells it is wide") {
  constexpr double radius = 0.01, skin = 0.008, reach = 2 * radius + skin;
  for (const double period : {2.05 * reach, 2.9 * reach, 3.1 * reach, 4.2 * reach, 9.5 * reach}) {
    const RandomStream draws(3, "pairs");
    std::vector<Vec3> centres;
    for (std::uint64_t n = 0; n < 900; n += 3)
      centres.push_back(
          {draws.uniform(n, -period, 2 * period), draws.uniform(n + 1, 0, 0.2), draws.uniform(n + 2, 0, 0.2)});
    const Domain slice{period};
    int near = 0;
    for (std::size_t i = 0; i < centres.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (norm(slice.minimum_image(slice.put_back(centres[i]), slice.put_back(centres[j]))) < reach) ++near;
    Particles particles = make_particles(centres, std::vector<double>(centres.size(), radius), 2500);
    Pairs pairs;
    rebuild(particles, slice, pairs, 0, AttractionReach{}, skin, kernels_of_this_processor().find_near);
    int listed = 0;
    for (const Block& block : pairs.blocks)
      block.candidates.each(block.grains, [&](NeighbourList::Pair pair, std::int32_t i) {
        const std::int32_t j = pair.grain();
        CHECK(i < j);
        CHECK(apart_in_slice(particles.motion[i].position, particles.motion[j].position, period) < 1.0001 * reach);
        if (apart_in_slice(particles.motion[i].position, particles.motion[j].position, period) < reach) ++listed;
      });
    INFO(period / reach);
    REQUIRE(near > 100);
    CHECK(listed == near);
  }
}

TEST_CASE("a contact remembers its slip when it is carried through the seam again and again") {
  ContactModel model = sticky_paste();
  model.cohesion_n = 0.5;
  model.restitution = 0.999;                                // slip swings on
  constexpr double speed = 0.4, duration = 1, step = 2e-5;  // four times around
  const auto pair_of = [&](Scene scene) {
    scene.grain({0.03, 0, 0}, {speed, 0.002, 0}, {0, 0, 0.6}).grain({0.0499, 0, 0}, {speed, -0.002, 0}, {0, 0.3, 0.4});
    scene.run(duration, step);
    const Vec3 way = scene.world.domain.minimum_image(scene.motion(0).position, scene.motion(1).position);
    const Vec3 slower = scene.velocity(1) - scene.velocity(0);
    const Contact kept = scene.world.pairs.blocks[0].contacts.contact(0);
    const bool turned = scene.world.particles.identity[scene.world.pairs.blocks[0].contacts.first(0)] != 0;
    const Contact contact = turned ? kept.turned() : kept;
    return std::vector<double>{
        way.x,    way.y,           way.z,           slower.x,        slower.y,
        slower.z, contact.slip[0], contact.slip[1], contact.slip[2], contact.sqrt_contact_radius};
  };
  const std::vector<double> round = pair_of(in_slice(model)), straight = pair_of(Scene(model));
  REQUIRE(std::fabs(straight[6]) + std::fabs(straight[7]) > 1e-10);
  // Forces have 24 bits: a millionth of the distance, the speed, and the slip of a contact that slides.
  const double rounding[] = {1e-6 * 0.02, 1e-6 * speed, 1e-4 * std::fabs(straight[7]), 0};
  for (std::size_t k = 0; k < round.size(); ++k) {
    INFO(k);
    CHECK(round[k] == Approx(straight[k]).epsilon(1e-6).margin(rounding[k / 3]));
  }
}

TEST_CASE("where a slice begins changes nothing but the last bits of forces") {
  // Loads are summed in another order, in 24 bits; a longer run would show how a crowd magnifies that.
  constexpr double duration = 0.004, step = 2e-5;
  const auto run = [&](double shift) {
    Scene scene = in_slice(sticky_paste());
    add_crowd(scene, 4, shift);
    scene.run(duration, step);
    return scene;
  };
  const Scene still = run(0);
  REQUIRE(still.kinetic_energy() > 0);
  for (const double shift : {0.0137, 0.05, -0.033, 0.75}) {
    const Scene moved = run(shift);
    double farthest = 0;
    for (int i = 0; i < still.world.particles.count(); ++i) {
      const Vec3 back = moved.motion(i).position - Vec3{shift, 0, 0};
      farthest =
          std::max(farthest, apart_in_slice(still.world.domain.put_back(back), still.motion(i).position, kSlice));
    }
    INFO(shift);
    CHECK(farthest / 0.01 < 1e-6);
    CHECK(norm(moved.momentum() - still.momentum()) <
          1e-6 * std::sqrt(2 * still.world.particles.count() * still.mass(0) * still.kinetic_energy()));
  }
}

TEST_CASE("the bits of a slice do not depend on the number of threads") {
  const auto run = [](int threads) {
    Scene scene = in_slice(sticky_paste());
    scene.options.threads = threads;
    add_crowd(scene, 30, 0.011, 60);
    scene.run(0.01, 5e-5);
    return scene;
  };
  const Scene alone = run(1);
  REQUIRE(alone.world.pairs.blocks.size() > 2);
  for (const int threads : {2, 3}) {
    const Scene shared = run(threads);
    for (int i = 0; i < alone.world.particles.count(); i += 7) {
      CHECK(shared.motion(i).position.x == alone.motion(i).position.x);
      CHECK(shared.velocity(i).z == alone.velocity(i).z);
    }
  }
}

}  // namespace
}  // namespace pastefit
