#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/study/lab.h"
#include "calibrate/study/tests.h"
#include "tests/calibrate/files.h"
#include "tests/calibrate/study/desk.h"
#include "tests/calibrate/study/lab_file.h"

namespace pastefit {
namespace {

using nlohmann::json;
using test::at;
using test::faults_of;
using test::says;

json lab_with(const char* yield_stress) {
  json document = test::lab();
  document["material"]["yield_stress_pa"] = json::parse(yield_stress);
  return document;
}

TEST_CASE("a measured yield stress is read as a reading is, and a note says what a fluid with it would read") {
  const Lab lab = lab_from_json(lab_with(R"({"repeats": [290, 300, 310]})"), ".").value();
  REQUIRE(lab.yield_stress);
  CHECK(lab.yield_stress->value == 300);
  CHECK(lab.yield_stress->standard_deviation == 10);
  CHECK(lab.yield_stress->repeats == 3);
  REQUIRE(lab.notes.size() == 1);
  for (const char* words : {"300 Pa is compared, not fitted", "step1.height_mm 100 +- ", "Schowalter 1998"})
    CHECK(lab.notes[0].find(words) != std::string::npos);
  CHECK(lab.measurements.size() == 1);
  CHECK_FALSE(lab_from_json(test::lab(), ".").value().yield_stress);
}

TEST_CASE("a yield stress that is none is one fault with its place") {
  const std::string place = "material.yield_stress_pa";
  const auto only = [](const json& document) {
    const Faults faults = faults_of(document);
    INFO(message_of(faults));
    REQUIRE(faults.size() == 1);
    return faults[0].where;
  };
  CHECK(only(lab_with(R"({"value": 0, "standard_deviation": 5})")) == place + ".value");
  CHECK(only(lab_with(R"({"value": -300, "standard_deviation": 5})")) == place + ".value");
  CHECK(only(lab_with(R"({"value": 3e5, "standard_deviation": 5})")) == place + ".value");
  CHECK(only(lab_with(R"({"value": "300", "standard_deviation": 5})")) == place + ".value");
  CHECK(only(lab_with(R"({"value": 300, "standard_deviation": 0})")) == place + ".standard_deviation");
  CHECK(only(lab_with(R"({"value": 300})")) == place + ".standard_deviation");
  CHECK(only(lab_with(R"({"value": 300, "standard_deviation": 30, "unit": "Pa"})")) == place + ".unit");
  CHECK(only(lab_with("300")) == place);
}

TEST_CASE("a test without readings that say a yield stress refuses one") {
  json document = json::parse(template_text("drop-lab").value(), nullptr, true, true);
  REQUIRE(faults_of(document).empty());
  document["material"]["yield_stress_pa"] = {{"value", 300}, {"standard_deviation", 30}};
  CHECK(says(at(faults_of(document), "material.yield_stress_pa"), "drop test"));
}

TEST_CASE("where a yield stress is all that was measured, the fault says which reading it predicts") {
  for (const bool empty : {true, false}) {
    json document = lab_with(R"({"value": 300, "standard_deviation": 30})");
    document.erase("measurements");
    if (empty) document["measurements"] = json::object();
    const Faults faults = faults_of(document);
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].where == "measurements");
    for (const char* words : {"\"step1.height_mm\": {\"value\": 100, \"standard_deviation\": ", "Schowalter 1998",
                              "predicted, not measured"})
      CHECK(faults[0].remedy.find(words) != std::string::npos);
    document["material"].erase("yield_stress_pa");
    CHECK(faults_of(document)[0].remedy.find("predicted") == std::string::npos);
  }
}

TEST_CASE("no search knows of a measured yield stress") {
  const test::Desk desk;
  const Study without = desk.read(test::Desk::study()).value();
  json lab = json::parse(template_text("lab").value(), nullptr, true, true);
  lab["grains"] = {{"distribution", "mono"}, {"radius_mm", 8}};
  lab["measurements"]["step1.lateral_shift_mm"] = {{"value", 0}, {"standard_deviation", 20}};
  lab["material"]["yield_stress_pa"] = {{"value", 300}, {"standard_deviation", 30}};
  desk.folder().write("lab.json", lab.dump(2));
  const Study with = desk.read(test::Desk::study()).value();
  CHECK(with.tests[0].lab.yield_stress);
  CHECK(inputs_of(with) == inputs_of(without));
  CHECK(readings_of(with).size() == readings_of(without).size());
}

}  // namespace
}  // namespace pastefit
