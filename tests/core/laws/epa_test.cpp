#include <catch2/catch.hpp>
#include <cmath>

#include "core/laws/table.h"
#include "tests/core/scene.h"

using namespace pastefit;

namespace {

ContactModel yielding(NormalLaw law, double plasticity = 0.85, double adhesion = 1) {
  ContactModel model;
  model.youngs_modulus_pa = 2e6;
  model.normal = law;
  model.plasticity_ratio = plasticity;
  model.adhesion_ratio = adhesion;
  model.cohesion_n = 0;
  return model;
}

/// A contact of two equal grains of 10 mm that is led through overlaps one after the other.
template <class LawOfOverlap>
class LedContact {
 public:
  explicit LedContact(const ContactModel& model) : pair_(grain_pair(model, 0.01)) {}
  NormalForce<double> to(double overlap) {
    const auto normal = LawOfOverlap::at(pair_, std::sqrt(0.005), overlap, plastic_);
    plastic_ = normal.plastic;
    return normal;
  }

 private:
  PairConstants pair_;
  double plastic_ = 0;
};

}  // namespace

TEMPLATE_TEST_CASE("reloading goes parallel to unloading, from wherever it begins", "", Epa, Luding) {
  const double m = TestType::is_linear ? 1 : 1.5;
  LedContact<TestType> contact(yielding(TestType::choice));
  const double first = contact.to(1e-4).force;  // loading: k1 d^m
  CHECK(contact.to(2e-4).force == Approx(first * std::pow(2, m)).epsilon(1e-12));
  const auto slope = [&](double from, double to) {
    const double before = contact.to(from).force;
    return (contact.to(to).force - before) / (std::pow(to, m) - std::pow(from, m));
  };
  const double loading = first / std::pow(1e-4, m), unloading = loading / (1 - 0.85);
  CHECK(slope(2e-4, 1.95e-4) == Approx(unloading).epsilon(1e-9));
  CHECK(slope(1.95e-4, 1.99e-4) == Approx(unloading).epsilon(1e-9));
  CHECK(contact.to(2.5e-4).force == Approx(loading * std::pow(2.5e-4, m)).epsilon(1e-12));  // on to deeper loading
  const double along = contact.to(1e-4).force;
  CHECK(along == Approx(-loading * std::pow(1e-4, m)).epsilon(1e-12));  // the adhesion branch, kc = k1
  CHECK(slope(1e-4, 1.02e-4) == Approx(unloading).epsilon(1e-9));
}

TEMPLATE_TEST_CASE("a contact that has opened is loaded as for the first time", "", Epa, Luding) {
  LedContact<TestType> contact(yielding(TestType::choice));
  const double fresh = contact.to(1e-4).force;
  contact.to(3e-4);
  CHECK(contact.to(-1e-6).force == 0);
  CHECK(contact.to(1e-4).force == fresh);
}

TEMPLATE_TEST_CASE("friction feels the force and all adhesion that the overlap may have", "", Epa, Luding) {
  ContactModel model = yielding(TestType::choice, 0.85, 0.7);
  model.cohesion_n = 0.3;
  LedContact<TestType> contact(model);
  const double m = TestType::is_linear ? 1 : 1.5;
  const double loading = contact.to(1e-4).force / std::pow(1e-4, m);
  for (const double overlap : {2e-4, 1.9e-4, 1e-4}) {
    const auto normal = contact.to(overlap);
    const double adhesion = 0.7 * loading * std::pow(overlap, m);
    CHECK(normal.load == Approx(normal.force + adhesion).margin(1e-12 * adhesion));
    CHECK(normal.reserve == Approx(adhesion + 0.3).epsilon(1e-12));
  }
}

TEMPLATE_TEST_CASE("grains apart have no reserve that rolling or friction could feel", "", Epa, Luding) {
  ContactModel model = yielding(TestType::choice);
  model.cohesion_n = 0.3;
  LedContact<TestType> contact(model);
  CHECK(contact.to(1e-4).reserve > 0.3);
  const auto apart = contact.to(-1e-6);
  CHECK_FALSE(apart.touching);
  CHECK(apart.reserve == 0);
}

TEST_CASE("without plasticity and adhesion EPA is Hertz") {
  const auto final_state = [](NormalLaw law) {
    ContactModel model = yielding(law, 0, 0);
    model.friction = 0.5;
    Scene scene(model);
    scene.world.gravity = kGravity;
    scene.wall(Plane{}, {});
    for (int i = 0; i < 6; ++i) scene.grain({0.0207 * (i % 2) + 1e-4 * (i % 7), 0, 0.011 + 0.021 * (i / 2)});
    scene.run_by_itself(0.05);
    return scene.world.particles.motion;
  };
  const auto hertz = final_state(NormalLaw::hertz), epa = final_state(NormalLaw::epa);
  for (std::size_t i = 0; i < hertz.size(); ++i) CHECK(norm(hertz[i].position - epa[i].position) < 1e-8);
}

TEMPLATE_TEST_CASE("the energy of a box of grains that yield and adhere is accounted for, walls included", "", Epa,
                   Luding) {
  for (const double share : {0.0, 1.0}) {
    ContactModel model = yielding(TestType::choice);
    model.friction = 0.3;
    model.cohesion_n = 0.02;
    model.rolling_friction = 0.05;
    Scene scene(model);
    scene.world.gravity = kGravity;
    WallContact wall;
    wall.cohesion_factor = share;
    scene.wall(Plane{}, wall);
    scene.wall(Plane{{-0.012, 0, 0}, {1, 0, 0}}, wall).wall(Plane{{0.075, 0, 0}, {-1, 0, 0}}, wall);
    for (int i = 0; i < 48; ++i)
      scene.grain({0.0207 * (i % 4) + 2e-4 * (i % 7), 0.0207 * (i / 4 % 4), 0.012 + 0.022 * (i / 16)},
                  {0.1 * (i % 3 - 1), 0, -0.3});
    scene.run(0.3, 2e-5);
    const EnergyBalance& energy = scene.energy_balance();
    INFO("share of the attraction on walls " << share);
    CHECK(energy.dissipation_plastic > 0.1 * energy.put_in());
    CHECK(std::fabs(energy.error()) < 1e-3 * energy.put_in());
  }
}

TEMPLATE_TEST_CASE("the energy error of a collision that yields falls with the square of the step", "", Epa, Luding) {
  const auto error = [](double dt) {
    ContactModel model = yielding(TestType::choice, 0.85, 0.5);
    // The law alone: dashpots of a linear spring, friction and rolling cost an order, though at a tenth of the error.
    model.restitution = 1;
    model.friction = 0;
    model.rolling = RollingModel::none;
    Scene scene(model);
    scene.grain({-0.0101, 0, 0}, {0.3, 0.2, 0.1}, {1, 20, -10}).grain({0.0101, 0.004, 0});
    scene.run(0.028, dt);
    return std::fabs(scene.energy_balance().error()) / scene.energy_balance().put_in();
  };
  const double coarse = error(4e-5), fine = error(4e-6);
  CHECK(coarse < 5e-3);
  CHECK(fine < 0.05 * coarse);
}
