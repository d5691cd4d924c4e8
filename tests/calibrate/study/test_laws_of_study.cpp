#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/laboratory/names.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"
#include "core/laws/constants.h"
#include "core/laws/table.h"
#include "tests/calibrate/files.h"
#include "tests/calibrate/study/desk.h"

namespace pastefit {
namespace {

using nlohmann::json;
using test::at;
using test::Desk;
using test::says;

TEST_CASE("contact choices of the study reach the test") {
  json document = Desk::study();
  document["contact"] = {{"formation", "touch"}, {"rolling_model", "none"}, {"friction_basis", "total"}};
  const Result<Study> read = Desk().read(document);
  REQUIRE(read.ok());
  const Test of_study = test_with(read.value().tests[0].lab.test, values_at(read.value(), std::vector{0.5}), 3);
  const Specimen& test = specimen_of(of_study);
  CHECK(test.contact.bridge.formation == BridgeFormation::touch);
  CHECK(test.contact.rolling == RollingModel::none);
  CHECK(test.contact.friction_basis == FrictionBasis::total);
}

TEST_CASE("a study that chooses no law has Hertz and a polynomial bridge") {
  const Result<Study> read = Desk().read(Desk::study());
  REQUIRE(read.ok());
  const ContactModel& contact = specimen_of(read.value().tests[0].lab.test).contact;
  CHECK(contact.normal == NormalLaw::hertz);
  CHECK(contact.bridge.shape == BridgeShape::polynomial);
}

TEST_CASE("every law reaches the tests of a study, with its parameters and without those of others") {
  for (const auto& normal : normal_laws)
    for (const auto& attraction : bridge_shapes) {
      if (!go_together(normal.value, attraction.value)) continue;
      INFO(normal.name << ", " << attraction.name);
      json document = Desk::study();
      document["contact"] = {{"normal", normal.name}, {"attraction", attraction.name}};
      document["parameters"] = {{"friction", {{"free", {0.1, 0.9}}}}};
      const bool by_energy = normal.value == NormalLaw::jkr || normal.value == NormalLaw::dmt;
      if (by_energy) document["parameters"]["adhesion_pa"] = {{"value", 500}};
      if (normal.value == NormalLaw::sjkr) document["parameters"]["cohesion_energy_density_pa"] = {{"value", 600}};
      if (attraction.value != BridgeShape::none) document["parameters"]["strength_pa"] = {{"value", 700}};
      const Result<Study> read = Desk().read(document);
      INFO((read.ok() ? "" : message_of(read.faults())));
      REQUIRE(read.ok());
      const Test test = test_with(read.value().tests[0].lab.test, values_at(read.value(), std::vector{0.5}), 3);
      const auto& [grains, contact] = std::pair(specimen_of(test).grains, specimen_of(test).contact);
      const double radius = grains.radius_m;
      CHECK(contact.normal == normal.value);
      CHECK(contact.bridge.shape == attraction.value);
      CHECK(contact.surface_energy_j_m2 == (by_energy ? 500 * radius : 0));
      CHECK(contact.cohesion_energy_density_pa == (normal.value == NormalLaw::sjkr ? 600 : 0));
      CHECK(attraction_at_touch(contact.bridge, radius) ==
            Approx(attraction.value == BridgeShape::none ? 0 : 700 * radius * radius));
    }
}

TEST_CASE("parameters of laws that a study did not choose are refused, all at once, with their law") {
  json document = Desk::study();
  document["contact"] = {{"normal", "jkr"}, {"attraction", "none"}, {"rolling_model", "none"}};
  document["parameters"] = json::parse(R"({"adhesion_pa": {"free": [100, 10000]}, "strength_pa": {"free": [200, 6000]},
                                           "curvature": {"value": 0}, "rolling_friction": {"value": 0.1},
                                           "table_cohesion_factor": {"value": 0.5}})");
  const Faults faults = Desk().faults(document);
  REQUIRE(faults.size() == 3);
  CHECK(says(at(faults, "parameters.strength_pa"), "belongs to attraction \"polynomial\", \"linear\""));
  CHECK(says(at(faults, "parameters.strength_pa"), "chosen is attraction \"none\""));
  CHECK(says(at(faults, "parameters.curvature"), "belongs to attraction \"polynomial\"; "));
  CHECK(says(at(faults, "parameters.curvature"), "\"contact\": {\"attraction\": \"polynomial\"}"));
  CHECK(says(at(faults, "parameters.rolling_friction"), "rolling_model \"spring_dashpot\""));
  document = Desk::study();
  document["parameters"]["adhesion_pa"] = {{"value", 1000}};
  CHECK(says(at(Desk().faults(document), "parameters.adhesion_pa"),
             "belongs to normal \"jkr\", \"dmt\"; chosen is normal"));
  document["contact"] = {{"attraction", "cubic"}, {"normal", "hertzian"}};
  CHECK(says(at(Desk().faults(document), "contact.attraction"), "exponential"));
  CHECK(says(at(Desk().faults(document), "contact.normal"), "did you mean \"hertz\"?"));
}

TEST_CASE("a law of the overlap that goes beside no bridge is refused beside one, with what to write") {
  for (const char* normal : {"dmt", "sjkr"}) {
    json document = Desk::study();
    document["contact"] = {{"normal", normal}, {"attraction", "linear"}};
    document["parameters"] = {{"friction", {{"free", {0.1, 0.9}}}}};
    const Faults faults = Desk().faults(document);
    REQUIRE(faults.size() == 1);
    CHECK(says(at(faults, "contact.attraction"), "is \"linear\" beside normal \"" + std::string(normal) + "\""));
    CHECK(says(at(faults, "contact.attraction"), "\"attraction\": \"none\""));
    document["contact"]["attraction"] = "none";
    CHECK(Desk().faults(document).empty());
  }
}

TEST_CASE(
    "a viscosity that no step carries is a fault of the study that names the largest, at the worst corner of its "
    "bounds") {
  json document = Desk::study();
  document["parameters"]["viscosity_pa_s"] = {{"free", {0, 3}}};
  CHECK(Desk().faults(document).empty());
  document["parameters"]["viscosity_pa_s"] = {{"free", {0, 900}}};
  const Faults faults = Desk().faults(document);
  REQUIRE(faults.size() == 1);
  CHECK(says(at(faults, "parameters.viscosity_pa_s"), "is 900 Pa s"));
  CHECK(says(at(faults, "parameters.viscosity_pa_s"), "give at most "));
  document["parameters"]["youngs_modulus_pa"] = {{"free", {1e6, 1e9}}};
  document["parameters"]["viscosity_pa_s"] = {{"value", 60}};
  CHECK(says(at(Desk().faults(document), "parameters.viscosity_pa_s"), "is 60 Pa s"));
  document["parameters"]["youngs_modulus_pa"] = {{"value", 1e9}};
  CHECK(Desk().faults(document).empty());
}

TEST_CASE("without an attraction nothing is asked of a film") {
  json document = Desk::study();
  document["contact"] = {{"attraction", "none"}, {"formation", "touch"}};
  document["parameters"] = {{"friction", {{"free", {0.1, 0.9}}}}};
  CHECK(Desk().faults(document).empty());
}

}  // namespace
}  // namespace pastefit
