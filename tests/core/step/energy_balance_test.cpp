#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/core/scene.h"

using namespace pastefit;

namespace {

ContactModel soft(double restitution, double friction, RollingModel rolling) {
  ContactModel model;
  model.youngs_modulus_pa = 2e6;
  model.restitution = restitution;
  model.friction = friction;
  model.rolling = rolling;
  return model;
}

/// EnergyBalance after an oblique collision of two spinning grains, 700 (or, finer, 7000) steps.
EnergyBalance after_collision(const ContactModel& model, double dt) {
  World world;
  set_contact_model(world, model, 0.01);
  world.gravity = 0;
  world.particles = make_particles({{-0.0101, 0, 0}, {0.0101, 0.004, 0}}, {0.01, 0.01}, 2500);
  set_velocity(world.particles, 0, {0.3, 0.2, 0.1}, {1, 20, -10});
  StepOptions options;
  options.fixed_step_s = dt;
  Stepper stepper(world, options);
  for (int n = 0; n < static_cast<int>(0.028 / dt); ++n) REQUIRE_FALSE(stepper.step({}));
  return stepper.energy_balance();
}

}  // namespace

TEST_CASE("the energy balance of an oblique collision closes, whatever takes the energy") {
  for (const double e : {1.0, 0.3})
    for (const double mu : {0.0, 0.5})
      for (const RollingModel rolling :
           {RollingModel::none, RollingModel::spring_dashpot, RollingModel::constant_torque}) {
        const EnergyBalance energy_balance = after_collision(soft(e, mu, rolling), 4e-6);
        INFO("restitution " << e << " friction " << mu << " rolling " << static_cast<int>(rolling));
        CHECK(std::fabs(energy_balance.error()) < 1e-4 * energy_balance.start_kinetic);
        CHECK((energy_balance.dissipation_normal > 1e-3 * energy_balance.start_kinetic) == (e < 1));
        CHECK((energy_balance.dissipation_sliding > 1e-4 * energy_balance.start_kinetic) == (mu > 0));
        CHECK((energy_balance.dissipation_rolling > 1e-4 * energy_balance.start_kinetic) ==
              (rolling != RollingModel::none));
      }
}

TEST_CASE("the energy of grains that stick is accounted for, whether they part again or not") {
  for (const double gamma : {0.5, 5.0, 50.0})
    for (const auto basis : {FrictionBasis::elastic, FrictionBasis::total}) {
      ContactModel model = soft(0.7, 0.5, RollingModel::spring_dashpot);
      model.normal = NormalLaw::jkr;
      model.surface_energy_j_m2 = gamma;
      model.friction_basis = basis;
      const EnergyBalance energy_balance = after_collision(model, 4e-6);
      INFO("surface energy " << gamma << " friction of the " << (basis == FrictionBasis::total ? "total" : "elastic"));
      CHECK(energy_balance.dissipation_bridges > 0);
      CHECK(std::fabs(energy_balance.error()) < 2e-3 * energy_balance.put_in());
    }
}

TEST_CASE("the energy of an oblique collision is accounted for by DMT and SJKR") {
  for (const NormalLaw law : {NormalLaw::dmt, NormalLaw::sjkr})
    for (const auto basis : {FrictionBasis::elastic, FrictionBasis::total}) {
      ContactModel model = soft(0.7, 0.5, RollingModel::spring_dashpot);
      model.normal = law;
      model.surface_energy_j_m2 = 5;
      model.cohesion_energy_density_pa = 1e5;
      model.friction_basis = basis;
      const EnergyBalance energy_balance = after_collision(model, 4e-6);
      INFO("law " << static_cast<int>(law) << " friction of the "
                  << (basis == FrictionBasis::total ? "total" : "elastic"));
      CHECK(std::fabs(energy_balance.error()) < 1e-3 * energy_balance.put_in());
    }
}

TEST_CASE("DMT's and SJKR's attraction gives what it takes: elastic grains part as fast as they met") {
  for (const NormalLaw law : {NormalLaw::dmt, NormalLaw::sjkr}) {
    ContactModel model = soft(1, 0, RollingModel::none);
    model.normal = law;
    model.surface_energy_j_m2 = 20;
    model.cohesion_energy_density_pa = 2e5;
    Scene scene(model);
    scene.grain({-0.01001, 0, 0}, {0.1, 0, 0}).grain({0.01001, 0, 0}, {-0.1, 0, 0});
    const double dt = 1e-6;
    scene.run(0.02, dt);
    // DMT's force is there all at once: up to a step's way of it may be missed, at each end of the contact.
    const double jump = law == NormalLaw::dmt ? 4 * std::numbers::pi * 20 * 0.005 : 0;
    const double allowed = 1e-5 * scene.energy_balance().put_in() + jump * 0.2 * dt;
    INFO("law " << static_cast<int>(law));
    CHECK(scene.motion(1).position.x > 0.0101);
    CHECK(std::fabs(std::pow(scene.velocity(1).x / 0.1, 2) - 1) * scene.energy_balance().start_kinetic < allowed);
    CHECK(std::fabs(scene.energy_balance().error()) < allowed);
  }
}

TEST_CASE("what DMT's and SJKR's overlaps hold at the start is that of their strain") {
  for (const NormalLaw law : {NormalLaw::dmt, NormalLaw::sjkr}) {
    ContactModel model = soft(0.3, 0.5, RollingModel::none);
    model.normal = law;
    model.surface_energy_j_m2 = 20;
    model.cohesion_energy_density_pa = 1e5;
    Scene scene(model);
    scene.grain({0, 0, 0}).grain({0.0195, 0, 0});
    scene.run(0.02, 1e-5);
    const double hertz = 8.0 / 15 * (2e6 / (2 * (1 - 0.09))) * std::sqrt(0.005) * std::pow(0.0005, 2.5);
    INFO("law " << static_cast<int>(law));
    CHECK(scene.energy_balance().put_in() == Approx(hertz).epsilon(0.01));
    CHECK(std::fabs(scene.energy_balance().error()) < 1e-3 * scene.energy_balance().put_in());
  }
}

TEST_CASE("the error of the energy balance falls with the square of the step") {
  const ContactModel model = soft(0.3, 0.5, RollingModel::none);
  const double coarse = std::fabs(after_collision(model, 4e-5).error());
  const double fine = std::fabs(after_collision(model, 4e-6).error());
  CHECK(fine < 0.03 * coarse);
}

TEST_CASE("what overlaps hold at the start counts as put in") {
  Scene scene(soft(0.3, 0.5, RollingModel::none));
  scene.grain({0, 0, 0}).grain({0.0195, 0, 0});
  scene.run(0.02, 1e-5);
  const EnergyBalance& energy_balance = scene.energy_balance();
  const double hertz = 8.0 / 15 * (2e6 / (2 * (1 - 0.09))) * std::sqrt(0.005) * std::pow(0.0005, 2.5);
  CHECK(energy_balance.put_in() == Approx(hertz).epsilon(0.01));
  CHECK(std::fabs(energy_balance.error()) < 1e-3 * energy_balance.put_in());
}

TEST_CASE(
    "what overlaps of grains that stick hold at the start is that of their strain, and their bridges are put in") {
  ContactModel model = soft(0.3, 0.5, RollingModel::none);
  model.normal = NormalLaw::jkr;
  model.surface_energy_j_m2 = 20;
  Scene scene(model);
  const double radius = 0.005, modulus = 2e6 / (2 * (1 - 0.09)), unit = std::numbers::pi * 20 * radius;
  const double torn = std::cbrt(unit * radius / (4 * modulus)), y = 1.7;  // sqrt(a/a_t)
  const double overlap = torn * torn / radius * (std::pow(y, 4) - 4 * y);
  scene.grain({0, 0, 0}).grain({0.02 - overlap, 0, 0});
  scene.run(0.02, 1e-5);
  const double scale = unit * torn * torn / radius;
  const double held = scale * (2.0 / 15 * std::pow(y, 10) - 4.0 / 3 * std::pow(y, 7) + 2 * std::pow(y, 4) - 0.8);
  const double strain = held + 2 * std::numbers::pi * 20 * std::pow(torn * y * y, 2);
  const double touch = std::cbrt(4.0);
  const double bound =
      -scale * (2.0 / 15 * std::pow(touch, 10) - 4.0 / 3 * std::pow(touch, 7) + 2 * std::pow(touch, 4) - 0.8);
  const EnergyBalance& energy_balance = scene.energy_balance();
  CHECK(strain > 0);
  CHECK(energy_balance.put_in() == Approx(strain + bound).epsilon(0.01));
  CHECK(std::fabs(energy_balance.error()) < 1e-3 * energy_balance.put_in());
}

TEST_CASE("constant torque does not spin up a small grain among large ones") {
  ContactModel model = soft(0.3, 0.0, RollingModel::constant_torque);
  model.cohesion_n = 0.01;
  Scene scene(model);
  const double r = 0.01, small = 0.003, apart = r + small - 1e-5;
  scene.grain_of(small, {0, 0, 0}, {}, {0, 0, 1});
  for (int k = 0; k < 6; ++k) {
    Vec3 place;
    (k < 2 ? place.x : k < 4 ? place.y : place.z) = k % 2 == 0 ? apart : -apart;
    scene.grain_of(r, place);
  }
  double fastest = 0;
  for (int n = 0; n < 50; ++n) {
    scene.run(1e-4, 1e-5);
    fastest = std::max(fastest, norm(scene.spin(0)));
  }
  CHECK(fastest <= 1);
}

TEST_CASE("a bridge that forms across a gap spends the work it takes to part it") {
  ContactModel model = soft(0.5, 0, RollingModel::none);
  model.bridge = {BridgeShape::polynomial, BridgeFormation::film, 2e4, 80, 0.1, -0.002, 0.0004, 0, 0, 0};
  World world;
  set_contact_model(world, model, 0.01);
  world.gravity = 0;
  world.particles = make_particles({{0, 0, 0}, {0.0215, 0, 0}}, {0.01, 0.01}, 2500);
  set_velocity(world.particles, 0, {0.2, 0, 0}, {});
  StepOptions options;
  options.fixed_step_s = 1e-6;
  Stepper stepper(world, options);
  for (int n = 0; n < 20000; ++n) REQUIRE_FALSE(stepper.step({}));
  const EnergyBalance& energy_balance = stepper.energy_balance();
  const auto antiderivative = [](double d) { return 2e4 * d * d * d / 3 + 80 * d * d / 2 + 0.1 * d; };
  CHECK(energy_balance.dissipation_bridges == Approx(antiderivative(-0.0008) - antiderivative(-0.002)).epsilon(1e-3));
  CHECK(std::fabs(energy_balance.error()) < 2e-3 * energy_balance.put_in());
}

TEST_CASE("attraction across a gap does the work its law promises, for every shape") {
  for (std::size_t row = 1; row < Attractions::size; ++row) {
    const auto shape = static_cast<BridgeShape>(row);
    ContactModel model = soft(1, 0, RollingModel::none);
    model.cohesion_n = 0;
    model.bridge = {shape, BridgeFormation::touch, 2e4, 80, 0.1, -0.002, 0, 2e-9, 0.072, 0.3};
    World world;
    set_contact_model(world, model, 0.01);
    world.gravity = 0;
    world.particles = make_particles({{0, 0, 0}, {0.01999, 0, 0}}, {0.01, 0.01}, 2500);
    set_velocity(world.particles, 1, {0.3, 0, 0}, {});
    StepOptions options;
    options.fixed_step_s = 1e-6;
    Stepper stepper(world, options);
    for (int n = 0; n < 12000; ++n) REQUIRE_FALSE(stepper.step({}));
    const EnergyBalance& energy_balance = stepper.energy_balance();
    INFO("shape " << static_cast<int>(shape));
    CHECK(energy_balance.stored == Approx(0).margin(1e-12));
    CHECK(energy_balance.kinetic < 0.9999 * energy_balance.start_kinetic);
    CHECK(std::fabs(energy_balance.error()) < 1e-4 * energy_balance.start_kinetic);
  }
}
