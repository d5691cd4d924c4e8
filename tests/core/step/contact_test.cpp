#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>

#include "core/laws/jkr.h"
#include "tests/core/scene.h"

using namespace pastefit;

namespace {

ContactModel glass(double restitution, double friction = 0) {
  ContactModel model;
  model.youngs_modulus_pa = 4.8e10;
  model.poissons_ratio = 0.2;
  model.restitution = restitution;
  model.friction = friction;
  model.rolling = RollingModel::none;
  return model;
}

ContactModel soft_and_sticky(FrictionBasis basis) {
  ContactModel model = glass(0.3, 0.5);
  model.youngs_modulus_pa = 1e7;
  model.normal = NormalLaw::jkr;
  model.surface_energy_j_m2 = 1;
  model.friction_basis = basis;
  return model;
}

ContactModel bridged(BridgeFormation formation, double offset) {
  ContactModel model = glass(1.0);
  model.youngs_modulus_pa = 1e7;
  model.bridge = {BridgeShape::polynomial, formation, 2e4, 80, 0.1, -0.002, offset, 0, 0, 0};
  return model;
}

}  // namespace

TEST_CASE("a Hertz collision of glass spheres lasts as long and presses as deep as theory says") {
  // Chung & Ooi 2011, test 1: R 10 mm, +-10 m/s: overlap 0.27411 mm, contact 40.34 us.
  Scene scene(glass(1.0), 0.01, 2800);
  scene.grain({-0.01 - 1e-9, 0, 0}, {10, 0, 0}).grain({0.01 + 1e-9, 0, 0}, {-10, 0, 0});
  const double dt = 40.34e-6 / 400;
  double deepest = 0;
  double end = 0;
  for (int n = 0; n < 500; ++n) {
    scene.run(dt, dt);
    const double overlap = 0.02 - norm(scene.motion(1).position - scene.motion(0).position);
    deepest = std::max(deepest, overlap);
    if (overlap > 0) end = scene.world.time;
  }
  CHECK(deepest == Approx(0.27411e-3).epsilon(1e-3));
  CHECK(end == Approx(40.34e-6).epsilon(5e-3));
  CHECK(scene.velocity(1).x == Approx(10).epsilon(1e-5));
}

TEST_CASE("the restitution that comes out is the one that was put in") {
  for (const double e : {0.2, 0.4, 0.6, 0.8, 0.95}) {
    Scene scene(glass(e), 0.01, 2800);
    scene.grain({-0.01 - 1e-9, 0, 0}, {1, 0, 0}).grain({0.01 + 1e-9, 0, 0}, {-1, 0, 0});
    const double duration = 40.34e-6 * std::pow(10, 0.2);
    // The damping coefficient starts like d^(1/4), so the error falls only a little faster than the step.
    scene.run(3 * duration, duration / 1600);
    INFO("restitution " << e);
    CHECK(scene.velocity(1).x == Approx(e).epsilon(1e-3));
  }
}

TEST_CASE("a sliding impact turns the grain as Coulomb friction says") {
  // Chung & Ooi 2011, test 4 in gross sliding: tangential restitution 1 - mu(1+e)/tan(theta), spin 5 mu(1+e) v
  // cos/(2R).
  ContactModel model = glass(0.98, 0.092);
  model.youngs_modulus_pa = 7e10;
  model.poissons_ratio = 0.33;
  const double v = 3.9, theta = 70 * std::numbers::pi / 180, radius = 2.5e-3;
  Scene scene(model, radius, 2700);
  scene.grain({0, 0, radius + 1e-12}, {v * std::sin(theta), 0, -v * std::cos(theta)});
  scene.wall(Plane{}, {1e20, 0.33, 0.98, 0.092, 0, 0});
  scene.run(4e-5, 1e-8);
  const double change = 0.092 * 1.98;
  CHECK(scene.velocity(0).x / (v * std::sin(theta)) == Approx(1 - change / std::tan(theta)).epsilon(1e-2));
  CHECK(scene.spin(0).y == Approx(5 * change * v * std::cos(theta) / (2 * radius)).epsilon(1e-2));
}

TEST_CASE("equal spheres with equal spins part without tangential velocity") {
  // Chung & Ooi 2011, test 7.
  Scene scene(glass(0.5, 0.4), 0.1, 2699);
  scene.grain({-0.1 - 1e-9, 0, 0}, {0.2, 0, 0}, {0, 0, 3}).grain({0.1 + 1e-9, 0, 0}, {-0.2, 0, 0}, {0, 0, -3});
  scene.run(5e-3, 1e-6);
  constexpr double rounding = 1e-7;  // of forces
  CHECK(std::fabs(scene.velocity(0).y) < rounding * 3 * 0.1);
  CHECK(scene.spin(0).z == Approx(3).epsilon(rounding));
}

TEST_CASE("a bridge pulls with a d^2 + b d + c down to the rupture gap, and not beyond") {
  const ContactModel model = bridged(BridgeFormation::film, 0.001);
  for (const double gap : {1e-4, 5e-4, 1e-3, 1.9e-3}) {
    Scene scene(model);
    scene.grain({0, 0, 0}).grain({0.02 + gap, 0, 0});
    scene.run(1e-6, 1e-6);
    scene.run(1e-6, 1e-6);
    INFO("gap " << gap);
    const double force = scene.velocity(0).x * scene.mass(0) / 1.5e-6;  // half kick, then a whole one
    CHECK(force == Approx(2e4 * gap * gap - 80 * gap + 0.1).epsilon(1e-6));
  }
  Scene apart(model);
  apart.grain({0, 0, 0}).grain({0.0221, 0, 0});
  apart.run(1e-5, 1e-6);
  CHECK(apart.velocity(0).x == 0);
}

TEST_CASE("in overlap a bridge's pull passes over into the cohesion within a hundredth of a radius") {
  const auto push = [](double overlap, double cohesion) {
    ContactModel model = bridged(BridgeFormation::film, 0.001);
    model.cohesion_n = cohesion;
    Scene scene(model);
    scene.grain({0, 0, 0}).grain({0.02 - overlap, 0, 0});
    scene.run(1e-7, 1e-7);
    return -scene.velocity(0).x * scene.mass(0) / 0.5e-7;  // a half kick
  };
  for (const double cohesion : {0.0, 0.03, 0.4}) {
    INFO("cohesion " << cohesion);
    for (const double share : {0.25, 0.5, 0.75, 1.5}) {
      const double left = std::max(1 - share, 0.0), overlap = share * 1e-4;
      CHECK(push(overlap, 0.1) - push(overlap, cohesion) == Approx((1 - left) * (cohesion - 0.1)).epsilon(1e-4));
    }
  }
}

TEST_CASE("a bridge forms at the formation gap and lives until rupture") {
  // Grains that approach at 1.2 mm do not pull; having been at 0.5 mm they do.
  const auto velocity_gained_at_1200_um = [](double first_gap, BridgeFormation formation) {
    Scene scene(bridged(formation, 0.0004));
    scene.grain({0, 0, 0}).grain({0.02 + first_gap, 0, 0});
    scene.run(1e-7, 1e-7);
    scene.world.particles.motion[1].position.x = scene.world.particles.motion[0].position.x + 0.0212;
    const double before = scene.velocity(0).x;
    scene.run(1e-6, 1e-7);
    return scene.velocity(0).x - before;
  };
  CHECK(velocity_gained_at_1200_um(1.2e-3, BridgeFormation::film) == 0);
  CHECK(velocity_gained_at_1200_um(0.5e-3, BridgeFormation::film) > 0);
  CHECK(velocity_gained_at_1200_um(0.5e-3, BridgeFormation::touch) == 0);
  CHECK(velocity_gained_at_1200_um(-1e-6, BridgeFormation::touch) > 0);
}

TEST_CASE("grains part for good above the escape speed of a bridge and stay together below it") {
  const ContactModel model = bridged(BridgeFormation::touch, 0.0);
  const Bridge& b = model.bridge;
  const double d = b.d_c_m, work = -(b.a_n_m2 * d * d * d / 3 + b.b_n_m * d * d / 2 + b.c_n * d);
  for (const double share : {0.99, 1.01}) {
    Scene scene(model);
    scene.grain({0, 0, 0}).grain({0.02, 0, 0});
    scene.run(1e-9, 1e-9);
    const double escape = std::sqrt(2 * work / (0.5 * scene.mass(0)));
    set_velocity(scene.world.particles, 1, {share * escape, 0, 0}, {});
    scene.run(0.05, 1e-6);
    const double gap = norm(scene.motion(1).position - scene.motion(0).position) - 0.02;
    INFO("share of the escape speed " << share);
    CHECK((gap > 0.002) == (share > 1));
  }
}

TEST_CASE("contacts in free space keep momentum") {
  Scene scene(glass(0.5, 0.4));
  scene.grain({0, 0, 0}, {1, 0.2, 0}, {5, 0, 2}).grain({0.0201, 0.001, 0}, {-1, 0, 0.3}).grain({0.01, 0.0178, 0.002});
  scene.run(1e-9, 1e-9);
  const Vec3 before = scene.momentum();
  scene.run(2e-3, 1e-7);
  const Vec3 change = scene.momentum() - before;
  CHECK(norm(change) < 1e-12 * norm(before));
}

// Grains that go around each other change places in the lists, and their contact is turned.
TEST_CASE("grains of two sizes go around each other alike, wherever they start") {
  ContactModel model = bridged(BridgeFormation::film, 0.001);
  model.friction = 0.5;
  model.rolling = RollingModel::spring_dashpot;
  model.rolling_friction = 0.1;
  const auto way_after_some_rounds = [&](bool quarter_turn) {
    const auto turned = [&](double x, double y) { return quarter_turn ? Vec3{-y, x, 0} : Vec3{x, y, 0}; };
    Scene scene(model);
    scene.grain_of(0.01, {}, turned(0, -0.01)).grain_of(0.005, turned(0.0149, 0), turned(0, 0.2), {0, 0, 30});
    for (double x = -0.1; x < 0.11; x += 0.2) scene.grain({x, x, x});  // far away: the cells stay where they are
    scene.run(1, 2e-6);
    const Vec3 way = scene.motion(1).position - scene.motion(0).position;
    return quarter_turn ? Vec3{way.y, -way.x, way.z} : way;
  };
  CHECK(norm(way_after_some_rounds(true) - way_after_some_rounds(false)) < 1e-4 * 0.015);
}

TEST_CASE("grains of three sizes that go around each other keep their angular momentum") {
  ContactModel model = bridged(BridgeFormation::film, 0.001);
  model.friction = 0.5;
  model.rolling = RollingModel::spring_dashpot;
  model.rolling_friction = 0.1;
  Scene scene(model);
  scene.grain_of(0.01, {0, 0, 0}).grain_of(0.005, {0.0149, 0, 0}, {0, 0.2, 0.1}, {0, 0, 30});
  scene.grain_of(0.007, {0, 0.0169, 0}, {-0.2, 0, 0.1}, {20, 0, 0});
  const auto angular_momentum = [&] {
    Vec3 sum;
    for (int k = 0; k < 3; ++k) {
      const double m = scene.mass(k), r = scene.motion(k).radius;
      sum += m * cross(scene.motion(k).position, scene.velocity(k)) + 0.4 * m * r * r * scene.spin(k);
    }
    return sum;
  };
  scene.run(1e-9, 1e-9);
  const Vec3 before = angular_momentum();
  scene.run(1, 2e-6);
  CHECK(norm(angular_momentum() - before) < 1e-5 * norm(before));
}

// A slip that is nothing but rounding may lie along the normal as a whole; given its length back, it once grew to half
// a millimetre within a step.
TEST_CASE("a head-on collision leaves no slip, however it is rounded") {
  ContactModel model = glass(0.3, 0.5);
  model.youngs_modulus_pa = 2e6;
  double most = 0;
  for (int n = 0; n < 400; ++n) {
    Scene scene(model);
    const double speed = 0.5 + 0.005 * n;
    scene.grain({0, 0, 0.013}).grain({0, 0, 0.033001}, {0, 0, -speed});
    for (int step = 0; step < 120; ++step) {
      scene.run(5e-5, 5e-5);
      for (const Block& block : scene.world.pairs.blocks)
        if (block.contacts.count > 0)
          for (const float slip : block.contacts.contact(0).slip) most = std::max<double>(most, std::fabs(slip));
    }
  }
  // Speeds have 24 bits: in a hundred steps they may differ by as many times that of the way.
  CHECK(most < 100 * 2.5 * 5e-5 / (1 << 24));
}

TEST_CASE("no oblique collision gains energy") {
  for (int n = 0; n < 400; ++n) {
    const double angle = 0.5 * std::numbers::pi * (n % 20 + 0.5) / 20, e = 0.1 + 0.9 * ((n / 20) % 5) / 4.0;
    const double mu = 0.05 * std::pow(3.0, n / 100);
    Scene scene(glass(e, mu), 0.01, 2800);
    scene.grain({-0.01 - 1e-9, 0, 0}, {std::cos(angle), std::sin(angle), 0},
                {0, 40.0 * (n % 3 - 1), 60.0 * (n % 7 - 3)});
    scene.grain({0.01 + 1e-9, 0, 0});
    scene.run(1e-12, 1e-12);
    const double before = scene.kinetic_energy();
    const double duration = 40.34e-6 * std::pow(20 / std::max(std::cos(angle), 0.02), 0.2);
    scene.run(3 * duration, duration / 100);
    INFO("angle " << angle << " restitution " << e << " friction " << mu);
    CHECK(scene.kinetic_energy() <= before * (1 + 1e-4));
  }
}

TEST_CASE("without surface energy JKR and DMT are Hertz, and SJKR is without energy density, bit for bit") {
  const NormalLaw sticking = GENERATE(NormalLaw::jkr, NormalLaw::dmt, NormalLaw::sjkr);
  const auto final_state = [sticking](NormalLaw law) {
    ContactModel model = bridged(BridgeFormation::film, 0.001);
    if (sticking != NormalLaw::jkr) model.bridge = {};  // which go beside no bridge
    model.normal = law;
    model.friction = 0.5;
    Scene scene(model);
    scene.world.gravity = kGravity;
    scene.wall(Plane{}, {});
    for (int i = 0; i < 12; ++i) scene.grain({0.0207 * (i % 4) + 1e-4 * (i % 7), 0, 0.011 + 0.021 * (i / 4)});
    scene.run_by_itself(0.1);
    return scene.world.particles.motion;
  };
  const auto one = final_state(NormalLaw::hertz), other = final_state(sticking);
  CHECK(std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0);
}

TEST_CASE("a grain that only sticks to a plane rolls along it, and slides where friction is of the net force") {
  // JKR: nothing presses the grain but its own attraction, so that the net force is zero. Where it is held by friction,
  // sliding ends at 5/7 of the speed, with 2/7 of it lost to friction.
  for (const auto basis : {FrictionBasis::elastic, FrictionBasis::total, FrictionBasis::net}) {
    ContactModel model = soft_and_sticky(basis);
    const double radius = 0.01, speed = 0.02;
    Scene scene(model, radius);
    scene.wall(Plane{}, {1e20, 0.3, 0.3, 0.5, 0, 1});
    const double overlap = Jkr::overlap_under(scene.world.walls[0].pair, radius, 0);
    scene.grain({0, 0, radius - overlap}, {speed, 0, 0});
    scene.run(0.05, 1e-6);
    INFO("basis " << static_cast<int>(basis));
    CHECK(scene.velocity(0).x == Approx(basis == FrictionBasis::net ? speed : 5.0 / 7 * speed).epsilon(2e-3));
    CHECK(scene.spin(0).y * radius == Approx(basis == FrictionBasis::net ? 0 : 5.0 / 7 * speed).margin(2e-3 * speed));
  }
}

TEST_CASE("a contact that sticks is kept while its grains are listed anew") {
  // Two grains on their way, held together by JKR alone, and at the start across a gap.
  ContactModel model = glass(1.0);
  model.youngs_modulus_pa = 1e7;
  model.normal = NormalLaw::jkr;
  model.surface_energy_j_m2 = 10;
  Scene scene(model);
  scene.grain({0, 0, 0}, {1, 0, 0}).grain({0.02 - 1e-6, 0, 0}, {1, 0, 0});
  scene.run(1e-7, 1e-7);
  const double gap = 0.9 * scene.world.grain_pair.pull_off_gap;
  scene.world.particles.motion[1].position.x = scene.world.particles.motion[0].position.x + 0.02 + gap;
  scene.run(0.2, 1e-5);
  CHECK(norm(scene.motion(1).position - scene.motion(0).position) < 0.02 + scene.world.grain_pair.pull_off_gap);
}

TEST_CASE("AVX2 and AVX-512 give the same bits, four lanes the same collision") {
  const NormalLaw law =
      GENERATE(NormalLaw::hertz, NormalLaw::jkr, NormalLaw::dmt, NormalLaw::sjkr, NormalLaw::epa, NormalLaw::luding);
  const auto final_state = [law](const KernelTable& kernels, double duration) {
    ContactModel model = bridged(BridgeFormation::film, 0.001);
    model.normal = law;
    if (!go_together(law, model.bridge.shape)) model.bridge = {};
    model.surface_energy_j_m2 = 0.5;
    model.cohesion_energy_density_pa = 5e5;
    model.plasticity_ratio = 0.8;
    model.adhesion_ratio = 1.5;
    model.friction = 0.5;
    model.rolling = RollingModel::spring_dashpot;
    model.restitution = 0.5;
    Scene scene(model);
    scene.options.kernels = &kernels;
    scene.world.gravity = kGravity;
    scene.wall(Plane{}, {});
    for (int i = 0; i < 60; ++i)
      scene.grain({0.0207 * (i % 4) + 1e-4 * (i % 7), 0.0209 * (i / 4 % 4), 0.011 + 0.021 * (i / 16)});
    scene.run_by_itself(duration);
    return scene.world.particles.motion;
  };
  const auto tables = kernels_this_processor_runs();  // the widest first, those of four lanes last
  if (tables.size() == 1) return;
  const KernelTable& widest = *tables.front();
  const auto one = final_state(widest, 0.3), other = final_state(*tables[tables.size() - 2], 0.3);
  CHECK(std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0);
  // Four lanes round a b + c twice: the last bits differ, and with them in the end the heap.
  const auto fused = final_state(widest, 0.02), plain = final_state(four_lanes::kernels, 0.02);
  double apart = 0;
  for (std::size_t i = 0; i < fused.size(); ++i) apart = std::max(apart, norm(fused[i].position - plain[i].position));
  CHECK(apart < 1e-9);
}
