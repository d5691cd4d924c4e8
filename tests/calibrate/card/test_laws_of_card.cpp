#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "calibrate/card/card.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/report/summary.h"
#include "calibrate/study/parameters.h"
#include "core/laws/table.h"

using namespace pastefit;

namespace {

Card card_with(NormalLaw normal, BridgeShape attraction, RollingModel rolling = RollingModel::spring_dashpot) {
  Card card;
  card.title = "of other laws";
  for (const ParameterKind& kind : parameter_kinds())
    card.material.parameters.push_back({std::string(kind.name), false, kind.default_value, 0, 0, kind.scale});
  CardTest& test = card.tests.emplace_back();
  ContactModel& contact = specimen_of(test.test).contact;
  contact.normal = normal;
  contact.bridge.shape = attraction;
  contact.rolling = rolling;
  test.test = with_contact_of(test.test, default_values());
  const Specimen& specimen = specimen_of(test.test);
  card.material.bulk_density_kg_m3 = specimen.bulk_density_kg_m3;
  card.material.grains = specimen.grains;
  card.material.contact = specimen.contact;
  return card;
}

nlohmann::json text_and_back(const Card& card) {
  return nlohmann::json::parse(to_json(card).dump());
}

}  // namespace

TEST_CASE("a card of every law reads back as it was written, and names the parameters of its laws only") {
  for (const auto& normal : normal_laws)
    for (const auto& attraction : bridge_shapes)
      for (const auto& rolling : rolling_models) {
        if (!go_together(normal.value, attraction.value)) continue;
        INFO(normal.name << ", " << attraction.name << ", " << rolling.name);
        const Card card = card_with(normal.value, attraction.value, rolling.value);
        const auto document = text_and_back(card);
        const auto read = card_from_json(document);
        INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
        REQUIRE(read.ok());
        CHECK(to_json(read.value()).dump() == to_json(card).dump());
        for (const ParameterKind& kind : parameter_kinds()) {
          const bool has = has_parameter(card.material.contact, kind.name);
          CHECK(document["material"]["parameters"].contains(kind.name) == has);
          CHECK((summary_of(card).find("  " + std::string(kind.name) + " ") != std::string::npos) == has);
        }
      }
}

TEST_CASE("a card whose surface energy or liquid was edited in one place says where") {
  auto document = text_and_back(card_with(NormalLaw::jkr, BridgeShape::capillary));
  for (const auto* place : {"/material/contact/surface_energy_j_m2", "/material/contact/bridge/liquid_volume_m3",
                            "/material/contact/bridge/surface_tension_n_m"}) {
    auto& number = document[nlohmann::json::json_pointer(place)];
    number = 1.001 * number.get<double>();
  }
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  std::string places;
  for (const auto& fault : read.faults()) places += fault.where + " ";
  CHECK(places ==
        "material.contact.bridge.liquid_volume_m3 material.contact.bridge.surface_tension_n_m "
        "material.contact.surface_energy_j_m2 ");
}

TEST_CASE("a card of SJKR whose energy density was edited in one place, or that has a bridge besides, says where") {
  const auto whole = text_and_back(card_with(NormalLaw::sjkr, BridgeShape::none));
  for (const auto& [place, value, where] :
       {std::tuple("/material/contact/cohesion_energy_density_pa", nlohmann::json(1), "cohesion_energy_density_pa"),
        std::tuple("/material/contact/bridge/shape", nlohmann::json("linear"), "bridge.shape")}) {
    auto document = whole;
    document[nlohmann::json::json_pointer(place)] = value;
    const auto read = card_from_json(document);
    REQUIRE_FALSE(read.ok());
    INFO(read.faults()[0].where);
    CHECK(read.faults()[0].where.ends_with(where));
  }
}

TEST_CASE("an older card that names the coefficient of a rolling law it has not is read") {
  auto document = text_and_back(card_with(NormalLaw::hertz, BridgeShape::polynomial, RollingModel::none));
  document["material"]["parameters"]["rolling_friction"] = 0.02;
  document["material"]["contact"]["rolling_friction"] = 0.02;
  const auto read = card_from_json(document);
  REQUIRE(read.ok());
  CHECK(card_from_json(text_and_back(read.value())).ok());
}

TEST_CASE("a card of any law is carried to another grain size") {
  for (const auto& normal : normal_laws)
    for (const auto& attraction : bridge_shapes) {
      if (!go_together(normal.value, attraction.value)) continue;
      INFO(normal.name << ", " << attraction.name);
      const auto carried = rescaled(card_with(normal.value, attraction.value), 0.006);
      REQUIRE(carried.ok());
      CHECK(card_from_json(text_and_back(carried.value())).ok());
    }
}

TEST_CASE("a card of a test without mould and table names no parameter of theirs") {
  Card card = card_with(NormalLaw::jkr, BridgeShape::none);
  const Specimen specimen = specimen_of(card.tests[0].test);
  card.tests[0].test = ShearCell{};
  specimen_of(card.tests[0].test) = specimen;
  const auto parameters = nlohmann::json::parse(to_json(card).dump())["material"]["parameters"];
  const std::string summary = summary_of(card);
  for (const char* name : {"mould_friction", "table_friction", "mould_cohesion_factor", "table_cohesion_factor"}) {
    CHECK_FALSE(parameters.contains(name));
    CHECK(summary.find(name) == std::string::npos);
  }
  CHECK(parameters.contains("friction"));
}
