#include "core/laws/lubrication.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "core/apparatus/field_checker.h"
#include "core/random.h"
#include "tests/core/scene.h"

using namespace pastefit;

namespace {

constexpr double kRadius = 0.008;

ContactModel paste(double viscosity) {
  ContactModel model;
  model.cohesion_n = 0.1;
  model.friction = 0.3;
  model.bridge.shape = BridgeShape::polynomial;
  model.bridge.b_n_m = 0.1 / 0.004;
  model.bridge.c_n = 0.1;
  model.bridge.d_c_m = -0.004;
  model.bridge.offset_m = 0.001;
  model.bridge.viscosity_pa_s = viscosity;
  return model;
}

/// A hundred and twenty-five grains that fly and spin, about a layer of bridges apart, above a sticky floor.
Scene crowd(const ContactModel& model) {
  Scene scene(model, kRadius);
  const RandomStream draws(7, "crowd");
  std::uint64_t n = 0;
  const auto vector = [&](double most) {
    const double x = draws.uniform(n, -most, most), y = draws.uniform(n + 1, -most, most),
                 z = draws.uniform(n + 2, -most, most);
    n += 3;
    return Vec3{x, y, z};
  };
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z)
        scene.grain(Vec3{0.0175 * x, 0.0175 * y, 0.009 + 0.0175 * z} + vector(0.0005), vector(0.3), vector(20));
  WallContact floor;
  floor.cohesion_factor = 0.5;
  scene.wall(Plane{}, floor);
  scene.world.gravity = kGravity;
  return scene;
}

}  // namespace

TEST_CASE("the energy of a crowd in a viscous liquid is accounted for, from thin to as thick as there is") {
  double thinner = 0;
  for (const double viscosity : {0.01, 0.1, 1.0, 10.0}) {
    Scene scene = crowd(paste(viscosity));
    scene.run_by_itself(0.2);
    const EnergyBalance& energy_balance = scene.energy_balance();
    INFO("viscosity " << viscosity);
    CHECK_FALSE(scene.problem);
    CHECK(std::fabs(energy_balance.error()) < 0.01 * energy_balance.put_in());
    CHECK(energy_balance.dissipation_viscous > thinner);
    thinner = energy_balance.dissipation_viscous;
  }
}

TEST_CASE("viscous dampers stay stable at steps that are too long for them") {
  for (const double viscosity : {10.0, 1000.0, 1e5}) {
    Scene scene = crowd(paste(viscosity));
    scene.world.gravity = 0;
    scene.run(0.05, 2e-4);
    const EnergyBalance& energy_balance = scene.energy_balance();
    INFO("viscosity " << viscosity);
    CHECK_FALSE(scene.problem);
    CHECK(energy_balance.kinetic < 0.2 * energy_balance.start_kinetic);
  }
}

TEST_CASE("a pair that turns as a whole feels nothing of the liquid between") {
  ContactModel model = paste(1);
  model.bridge.b_n_m = 0;
  model.bridge.c_n = 1e-9;
  Scene scene(model, kRadius);
  const double half = kRadius + 0.0005, turning = 0.5;
  scene.grain({-half, 0, 0}, {0, -turning * half, 0}, {0, 0, turning});
  scene.grain({half, 0, 0}, {0, turning * half, 0}, {0, 0, turning});
  scene.run(0.001, 1e-6);
  CHECK(scene.spin(0).z == Approx(turning).epsilon(1e-4));
  CHECK(scene.velocity(0).y == Approx(-turning * half).epsilon(1e-4));
}

TEST_CASE("the bits of a viscous crowd do not depend on the threads, nor on whether its energy is counted") {
  const auto end_of = [](int threads, bool counted) {
    Scene scene = crowd(paste(1));
    scene.options.threads = threads;
    scene.options.energy_balance = counted;
    scene.run_by_itself(0.05);
    std::vector<double> places;
    for (int i = 0; i < 125; ++i) places.push_back(scene.motion(i).position.x);
    return places;
  };
  const std::vector<double> one = end_of(1, true);
  CHECK(end_of(3, true) == one);
  CHECK(end_of(1, false) == one);
}

TEST_CASE("liquid whose viscosity vanishes leaves a crowd as it would be without") {
  Scene without = crowd(paste(0)), thin = crowd(paste(1e-9));
  without.run(0.01, 1e-5);
  thin.run(0.01, 1e-5);
  for (int i = 0; i < 125; ++i) CHECK(norm(without.motion(i).position - thin.motion(i).position) < 1e-5 * kRadius);
}

TEST_CASE("the logarithm of lubrication is right to a millionth over the gaps that there are") {
  for (double x = 1.0 / 16; x <= 64; x *= 1.01) CHECK(detail::logarithm(x) == Approx(std::log(x)).margin(1e-6));
}

TEST_CASE("the step follows a viscosity that it could not carry, and the largest is a fault that names it") {
  const auto step_of = [](double viscosity) {
    Scene scene = crowd(paste(viscosity));
    scene.run_by_itself(0.002);
    return scene.time_step();
  };
  CHECK(step_of(0.01) == step_of(0));
  CHECK(step_of(20) == Approx(0.5 * step_of(10)).epsilon(0.05));

  Specimen specimen;
  specimen.grains = {SizeDistribution::mono, kRadius, 0, kRadius, kRadius};
  specimen.contact = paste(1);
  const auto faults_with = [&](double viscosity) {
    specimen.contact.bridge.viscosity_pa_s = viscosity;
    FieldChecker check;
    check_specimen(check, specimen);
    return check.take();
  };
  CHECK(faults_with(1).empty());
  const Faults faults = faults_with(1e4);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].where == "contact.bridge.viscosity_pa_s");
  const std::string remedy = faults[0].remedy;
  const double largest = std::stod(remedy.substr(remedy.find("at most ") + 8));
  CHECK(faults_with(0.999 * largest).empty());
  CHECK(faults_with(1.001 * largest).size() == 1);
  CHECK(faults_with(-1).size() == 1);
  specimen.contact.bridge = {};
  CHECK(faults_with(1).size() == 1);
}
