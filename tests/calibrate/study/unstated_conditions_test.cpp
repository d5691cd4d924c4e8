#include "calibrate/study/unstated_conditions.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/study/parameters.h"
#include "tests/calibrate/study/desk.h"

namespace pastefit {
namespace {

using nlohmann::json;
using test::Desk;

std::vector<std::string> unstated_in(const json& lab, const json& study) {
  const Desk desk;
  desk.folder().write("lab.json", lab.dump());
  std::vector<std::string> places;
  for (const UnstatedCondition& one : unstated_conditions(desk.read(study).value())) places.push_back(one.place);
  return places;
}

json preset_lab() {
  return json::parse(R"({"format": "pastefit-lab-1", "title": "a cone", "provenance": {"source": "a sheet"},
                         "apparatus": {"preset": "abrams"}, "material": {"bulk_density_kg_m3": 2300},
                         "measurements": {"step1.height_mm": {"value": 120, "standard_deviation": 7.5}}})");
}

}  // namespace

TEST_CASE("the speed of the lift and the frictions of the surfaces are unstated until a file gives them") {
  json lab = preset_lab(), study = Desk::study();
  const std::string lift = "apparatus.lift_velocity_mm_s", mould = "parameters.mould_friction",
                    table = "parameters.table_friction";
  CHECK(unstated_in(lab, study) == std::vector{lift, mould, table});
  lab["apparatus"]["lift_velocity_mm_s"] = 80;
  CHECK(unstated_in(lab, study) == std::vector{mould, table});
  study["parameters"]["table_friction"] = {{"free", {0.1, 1}}};
  CHECK(unstated_in(lab, study) == std::vector{mould});
  study["parameters"]["mould_friction"] = {{"value", 0.1}};
  CHECK(unstated_in(lab, study).empty());
}

TEST_CASE("a condition is changed in the tests where it acts and nowhere else") {
  const Desk desk;
  desk.folder().write("lab.json", preset_lab().dump());
  const Study study = desk.read(Desk::study()).value();
  const auto conditions = unstated_conditions(study);
  const Study slow = with_condition(study, conditions.at(0), 0.5),
              smooth = with_condition(study, conditions.at(1), 0.5);
  const auto lift = [](const Study& one) { return std::get<SlumpTest>(one.tests.at(0).lab.test).lift_velocity_m_s; };
  const auto friction = [](const Study& one) {
    return std::ranges::find(one.parameters, "mould_friction", &Parameter::name)->value;
  };
  CHECK(conditions.at(0).assumed == 100);
  CHECK(lift(slow) == 0.05);
  CHECK(friction(slow) == friction(study));
  CHECK(lift(smooth) == lift(study));
  CHECK(friction(smooth) == 0.5 * friction(study));
  // 10 m/s is the most that a test may have.
  CHECK(lift(with_condition(study, conditions.at(0), 1000)) == lift(study));
}

}  // namespace pastefit
