#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "calibrate/laboratory/names.h"
#include "calibrate/study/parameters.h"
#include "core/laws/constants.h"
#include "core/laws/table.h"

namespace pastefit {
namespace {

/// All parameters at their default values, the first five free over their whole admissible range.
Study bridge_study() {
  Study study;
  for (const ParameterKind& kind : parameter_kinds()) {
    const bool free = study.parameters.size() < 5;
    study.parameters.push_back(
        {std::string(kind.name), free, kind.default_value, kind.smallest, kind.largest, kind.scale});
  }
  return study;
}

double force(const Bridge& bridge, double d) {
  return bridge.a_n_m2 * d * d + bridge.b_n_m * d + bridge.c_n;
}

TEST_CASE("every point of the unit cube is an admissible bridge that is fit to run") {
  for (const BridgeFormation formation : {BridgeFormation::film, BridgeFormation::touch}) {
    Study study = bridge_study();
    Test own = with_default_contact(SlumpTest{});
    specimen_of(own).contact.bridge.formation = formation;
    std::ranges::find(study.parameters, "youngs_modulus_pa", &Parameter::name)->value = 1e9;  // carries the strongest
    std::vector<double> point(5);
    for (int corner = 0; corner < 243; ++corner) {
      for (int axis = 0, rest = corner; axis < 5; ++axis, rest /= 3) point[axis] = std::array{0.0, 0.37, 1.0}[rest % 3];
      const Test test = test_with(own, values_at(study, point), 1);
      const Bridge& bridge = specimen_of(test).contact.bridge;
      const double little = 1e-12 * bridge.c_n;
      INFO("corner " << corner);
      CHECK(bridge.c_n > 0);
      CHECK(bridge.d_c_m < 0);
      CHECK(bridge.b_n_m >= 0);
      CHECK(bridge.b_n_m + 2 * bridge.a_n_m2 * bridge.d_c_m >= -little / -bridge.d_c_m);
      CHECK(force(bridge, bridge.d_c_m) >= -little);
      CHECK(2 * bridge.offset_m <= -bridge.d_c_m);
      CHECK(validate(test).empty());
    }
  }
}

TEST_CASE("strength, rupture force, curvature, gap and offset are what their names say") {
  const double radius = 0.008;
  std::vector<double> values = default_values();
  values[0] = 5000;
  values[1] = 0.25;
  values[2] = 1;
  values[3] = 0.3;
  values[4] = 0.8;
  Test test = with_default_contact(SlumpTest{});
  specimen_of(test).grains.radius_m = radius;
  const Bridge bridge = specimen_of(with_contact_of(test, values)).contact.bridge;
  CHECK(bridge.c_n == Approx(0.32));
  CHECK(bridge.d_c_m == Approx(-0.0024));
  CHECK(bridge.offset_m == Approx(0.00096));
  CHECK(force(bridge, bridge.d_c_m) == Approx(0.25 * 0.32));
  CHECK(bridge.b_n_m + 2 * bridge.a_n_m2 * bridge.d_c_m == Approx(0).margin(1e-9));  // flat at rupture
  values[2] = -1;
  CHECK(specimen_of(with_contact_of(test, values)).contact.bridge.b_n_m == 0);  // flat at touch
  values[2] = 0;
  CHECK(specimen_of(with_contact_of(test, values)).contact.bridge.a_n_m2 == 0);  // straight
}

TEST_CASE("with formation by touch the shells reach as far as the bridge, whatever its film would be") {
  std::vector<double> values = default_values();
  values[3] = 0.5;
  values[4] = 0.1;
  const auto offset = [&](const Test& test) {
    return specimen_of(with_contact_of(test, values)).contact.bridge.offset_m;
  };
  Test test = with_default_contact(SlumpTest{});
  specimen_of(test).contact.bridge.formation = BridgeFormation::touch;
  CHECK(offset(test) == Approx(0.25 * 0.008));
  specimen_of(test).contact.bridge.formation = BridgeFormation::film;
  CHECK(offset(test) == Approx(0.025 * 0.008));
}

TEST_CASE("each parameter reaches its own place in the test") {
  std::vector<double> values = default_values();
  for (std::size_t i = 5; i < 17; ++i) values[i] = 0.1 + 0.01 * static_cast<double>(i);
  const auto test = std::get<SlumpTest>(with_contact_of(with_default_contact(SlumpTest{}), values));
  CHECK(test.contact.friction == values[5]);
  CHECK(test.contact.rolling_friction == values[6]);
  CHECK(test.contact.restitution == values[7]);
  CHECK(test.contact.youngs_modulus_pa == values[8]);
  CHECK(test.contact.poissons_ratio == values[9]);
  CHECK(test.contact.cohesion_n == values[10] * test.contact.bridge.c_n);
  CHECK(test.mould_wall.friction == values[11]);
  CHECK(test.table_wall.friction == values[12]);
  CHECK(test.mould_wall.rolling_friction == values[13]);
  CHECK(test.table_wall.rolling_friction == values[14]);
  CHECK(test.table_wall.cohesion_factor == values[15]);
  CHECK(test.mould_wall.cohesion_factor == values[16]);
}

TEST_CASE("mould and table resist rolling as a study says, and as before where it says nothing") {
  const auto by_default = std::get<SlumpTest>(with_contact_of(with_default_contact(SlumpTest{}), default_values()));
  CHECK(by_default.mould_wall.rolling_friction == SlumpTest{}.mould_wall.rolling_friction);
  CHECK(by_default.table_wall.rolling_friction == SlumpTest{}.table_wall.rolling_friction);
}

TEST_CASE("the unit interval spans the bounds exactly, in equal steps or equal ratios") {
  Study study = bridge_study();
  study.parameters[0].lower = 200;
  study.parameters[0].upper = 60000;
  const auto at = [&](double unit) { return values_at(study, std::vector<double>(5, unit)); };
  CHECK(at(0)[0] == 200);
  CHECK(at(1)[0] == 60000);
  CHECK(at(0.5)[0] == Approx(std::sqrt(200.0 * 60000.0)));
  CHECK(at(0.5)[1] == 0.5);
  CHECK(at(0.5)[5] == study.parameters[5].value);
  CHECK(free_count(study) == 5);
}

TEST_CASE("default values lie in their admissible range, and names are unique") {
  for (const ParameterKind& kind : parameter_kinds()) {
    CHECK(kind.smallest < kind.largest);
    CHECK(kind.default_value >= kind.smallest);
    CHECK(kind.default_value <= kind.largest);
    CHECK((kind.scale == Scale::linear || kind.smallest > 0));
    const auto same = [&](const ParameterKind& other) { return other.name == kind.name; };
    CHECK(std::count_if(parameter_kinds().begin(), parameter_kinds().end(), same) == 1);
  }
}

/// Calls `visit(law)` with every law of a list.
template <class... Laws, class Visitor>
void each(TypeList<Laws...>, const Visitor& visit) {
  (visit(Laws{}), ...);
}

template <class Visitor>
void each_law(const Visitor& visit) {
  each(NormalLaws{}, visit);
  each(Attractions{}, visit);
  each(RollingLaws{}, visit);
}

TEST_CASE("a law asks for the parameters that it names and for no others, and every one is a parameter") {
  each_law([](auto law) {
    INFO(law.word);
    std::set<std::string_view> asked, named(law.parameters.begin(), law.parameters.end());
    ContactModel contact;
    contact.bridge.formation = BridgeFormation::film;  // which asks for one more than touch
    law.make(contact, 0.008, [&](std::string_view name) {
      asked.insert(name);
      return 0.5;
    });
    for (const std::string_view name : named) {
      const auto is_it = [&](const ParameterKind& kind) { return kind.name.ends_with(name); };
      CHECK(std::ranges::any_of(parameter_kinds(), is_it));
    }
    named.erase("cohesion_factor");  // the surfaces'
    CHECK(asked == named);
  });
}

TEST_CASE("an attraction of any law has the strength and the gap that were asked for, and is fit to run") {
  for (const auto& [word, shape] : bridge_shapes) {
    if (shape == BridgeShape::none) continue;
    INFO(word);
    for (const double strength : {1.0, 5000.0, 1e7})
      for (const double gap : {1e-3, 0.3, 1.0}) {
        std::vector<double> values = default_values();
        values[0] = strength;
        values[3] = gap;
        values[8] = 1e11;  // carries the strongest
        Test test = SlumpTest{};
        specimen_of(test).contact.bridge.shape = shape;
        test = with_contact_of(test, values);
        const ContactModel& contact = specimen_of(test).contact;
        const double radius = specimen_of(test).grains.radius_m;
        CHECK(attraction_at_touch(contact.bridge, radius) == Approx(strength * radius * radius));
        CHECK(rupture_gap(contact.bridge, radius) == Approx(gap * radius));
        CHECK(contact.bridge.offset_m == Approx(0.5 * values[4] * gap * radius));
        CHECK(contact.cohesion_n == Approx(values[10] * strength * radius * radius));
        CHECK(validate(test).empty());
      }
  }
}

TEST_CASE("without an attraction nothing of one is left, and no cohesion") {
  Test test = with_default_contact(SlumpTest{});
  specimen_of(test).contact.bridge.shape = BridgeShape::none;
  const ContactModel contact = specimen_of(with_contact_of(test, default_values())).contact;
  CHECK(contact.cohesion_n == 0.0);
  CHECK(contact.bridge.c_n == 0);
  CHECK(contact.bridge.d_c_m == 0);
  CHECK(contact.bridge.offset_m == 0);
}

TEST_CASE("JKR's surface energy is the adhesion times the radius, and Hertz has none") {
  std::vector<double> values = default_values();
  values[17] = 2000;
  Test test = with_default_contact(SlumpTest{});
  CHECK(specimen_of(with_contact_of(test, values)).contact.surface_energy_j_m2 == 0);
  specimen_of(test).contact.normal = NormalLaw::jkr;
  test = with_contact_of(test, values);
  CHECK(specimen_of(test).contact.surface_energy_j_m2 == 2000 * specimen_of(test).grains.radius_m);
  specimen_of(test).contact.normal = NormalLaw::hertz;
  CHECK(specimen_of(with_contact_of(test, values)).contact.surface_energy_j_m2 == 0);
}

TEST_CASE("DMT has JKR's surface energy, SJKR an energy density, and neither has the other's") {
  std::vector<double> values = default_values();
  values[17] = 2000;
  values[18] = 30000;
  Test test = with_default_contact(SlumpTest{});
  specimen_of(test).contact.bridge.shape = BridgeShape::none;
  specimen_of(test).contact.normal = NormalLaw::dmt;
  test = with_contact_of(test, values);
  CHECK(specimen_of(test).contact.surface_energy_j_m2 == 2000 * specimen_of(test).grains.radius_m);
  CHECK(specimen_of(test).contact.cohesion_energy_density_pa == 0);
  specimen_of(test).contact.normal = NormalLaw::sjkr;
  test = with_contact_of(test, values);
  CHECK(specimen_of(test).contact.surface_energy_j_m2 == 0);
  CHECK(specimen_of(test).contact.cohesion_energy_density_pa == 30000);
  CHECK(validate(test).empty());
}

TEST_CASE("the same parameters for larger grains are the enlarged material, whatever its laws") {
  const std::vector<double> values = default_values();
  for (const auto& normal : normal_laws)
    for (const auto& shape : bridge_shapes) {
      INFO(normal.name << ", " << shape.name);
      Test small = SlumpTest{};
      specimen_of(small).contact.normal = normal.value;
      specimen_of(small).contact.bridge.shape = shape.value;
      Test large = small;
      specimen_of(large).grains = enlarged(specimen_of(small).grains, 1.5);
      const ContactModel made = specimen_of(with_contact_of(large, values)).contact;
      const ContactModel grown = enlarged(specimen_of(with_contact_of(small, values)).contact, 1.5);
      CHECK(made.surface_energy_j_m2 == Approx(grown.surface_energy_j_m2));
      CHECK(made.cohesion_energy_density_pa == grown.cohesion_energy_density_pa);
      CHECK(*made.cohesion_n == Approx(*grown.cohesion_n));
      using Number = double Bridge::*;
      for (const Number number :
           {&Bridge::a_n_m2, &Bridge::b_n_m, &Bridge::c_n, &Bridge::d_c_m, &Bridge::offset_m, &Bridge::liquid_volume_m3,
            &Bridge::surface_tension_n_m, &Bridge::contact_angle_rad, &Bridge::viscosity_pa_s})
        CHECK(made.bridge.*number == Approx(grown.bridge.*number));
    }
}

TEST_CASE("a parameter belongs to the laws that name it, and to every test if none does") {
  ContactModel laws;
  laws.bridge.shape = BridgeShape::polynomial;
  const auto missing = [&] {
    std::set<std::string_view> names;
    for (const ParameterKind& kind : parameter_kinds())
      if (!has_parameter(laws, kind.name)) names.insert(kind.name);
    return names;
  };
  using Names = std::set<std::string_view>;
  const std::string_view k = "cohesion_energy_density_pa";
  const Names of_yielding{"plasticity_ratio", "adhesion_ratio", "pull_off_pa"};
  const auto with_these = [](Names names, const Names& others) {
    names.insert(others.begin(), others.end());
    return names;
  };
  CHECK(missing() == with_these({"adhesion_pa", k}, of_yielding));
  laws.bridge.formation = BridgeFormation::touch;
  CHECK(missing() == with_these({"adhesion_pa", k, "formation_ratio"}, of_yielding));
  laws.bridge.formation = BridgeFormation::film;
  laws.bridge.shape = BridgeShape::exponential;
  CHECK(missing() == with_these({"adhesion_pa", k, "rupture_force_ratio", "curvature"}, of_yielding));
  laws.bridge.shape = BridgeShape::none;
  const Names of_attractions{"strength_pa",       "rupture_force_ratio", "curvature",     "formation_ratio",
                             "rupture_gap_ratio", "cohesion_ratio",      "viscosity_pa_s"};
  for (const NormalLaw law : {NormalLaw::jkr, NormalLaw::dmt, NormalLaw::sjkr}) {
    laws.normal = law;
    Names missed = with_these(of_attractions, of_yielding);
    missed.insert(law == NormalLaw::sjkr ? "adhesion_pa" : k);
    CHECK(missing() == missed);
  }
  for (const NormalLaw law : {NormalLaw::epa, NormalLaw::luding}) {
    laws.normal = law;
    CHECK(missing() == with_these(of_attractions, {"adhesion_pa", k}));
  }
  laws.normal = NormalLaw::hertz;
  laws.rolling = RollingModel::none;
  Names dry = with_these(of_attractions, of_yielding);
  dry.insert({"adhesion_pa", k, "rolling_friction", "mould_rolling_friction", "table_rolling_friction",
              "table_cohesion_factor", "mould_cohesion_factor"});
  CHECK(missing() == dry);
}

TEST_CASE("the packing seed is the one that was asked for") {
  CHECK(specimen_of(test_with(SlumpTest{}, default_values(), 77)).packing_seed == 77);
}

}  // namespace
}  // namespace pastefit
