#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/study/lab.h"
#include "core/apparatus/slump/slump_test.h"
#include "tests/calibrate/files.h"
#include "tests/calibrate/study/lab_file.h"

namespace pastefit {
namespace {

using nlohmann::json;
using test::at;
using test::faults_of;
using test::lab;
using test::says;

Measurement measured(const std::string& key, const char* content) {
  json document = lab();
  document["measurements"] = {{key, json::parse(content)}};
  const Result<Lab> read = lab_from_json(document, ".");
  INFO((read.ok() ? "" : message_of(read.faults())));
  REQUIRE(read.ok());
  REQUIRE(read.value().measurements.size() == 1);
  return read.value().measurements[0];
}

TEST_CASE("repeats give mean and sample deviation, and a stated deviation is their lower bound") {
  Measurement reading = measured("step1.height_mm", R"({"repeats": [68, 70, 72]})");
  CHECK(reading.value == 70);
  CHECK(reading.standard_deviation == 2);
  CHECK(reading.repeats == 3);
  reading = measured("step1.height_mm", R"({"repeats": [68, 70, 72], "standard_deviation": 7.5})");
  CHECK(reading.standard_deviation == 7.5);
  reading = measured("step1.height_mm", R"({"repeats": [68, 70, 72], "standard_deviation": 0.5})");
  CHECK(reading.standard_deviation == 2);
  reading = measured("step1.height_mm", R"({"repeats": [70, 70], "standard_deviation": 1})");
  CHECK(reading.standard_deviation == 1);
}

TEST_CASE("a slump is kept as the height that is left") {
  const Measurement reading = measured("step1.slump_mm", R"({"value": 130, "standard_deviation": 5})");
  CHECK(reading.reading == "step1.height_mm");
  CHECK(reading.value == 70);
  CHECK(measured("step2.slump_mm", R"({"repeats": [129, 131]})").value == 70);
}

TEST_CASE("without repeats that differ, a missing deviation is a fault that names the published one") {
  for (const char* content : {R"({"value": 70})", R"({"repeats": [70, 70]})"}) {
    json document = lab();
    document["measurements"]["step1.height_mm"] = json::parse(content);
    const Faults faults = faults_of(document);
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].where == "measurements.step1.height_mm.standard_deviation");
    CHECK(says(faults[0], "ASTM C143-98"));
  }
}

TEST_CASE("a measurement that the test cannot have is one fault") {
  const auto refused = [](const char* key, const char* content) {
    json document = lab();
    document["measurements"] = {{key, json::parse(content)}};
    return faults_of(document).size() == 1;
  };
  CHECK(refused("step1.height_mm", R"({"value": 210, "standard_deviation": 5})"));
  CHECK(refused("step1.height_mm", R"({"value": -1, "standard_deviation": 5})"));
  CHECK(refused("step1.slump_mm", R"({"value": 201, "standard_deviation": 5})"));
  CHECK(refused("step1.spread_mm", R"({"value": 45, "standard_deviation": 5})"));  // centimetres
  CHECK(refused("step1.spread_mm", R"({"value": 701, "standard_deviation": 5})"));
  CHECK(refused("fill.mass_kg", R"({"value": 8682, "standard_deviation": 5})"));  // grams
  CHECK(refused("step1.height_mm", R"({"value": 70, "standard_deviation": 0})"));
  CHECK(refused("step1.height_mm", R"({"repeats": [70], "standard_deviation": 1})"));
  CHECK(refused("step1.height_mm", R"({"repeats": [70, 71], "value": 70.5})"));
  CHECK(refused("step1.height_mm", R"({"standard_deviation": 1})"));
  CHECK(refused("step1.height_mm", R"(70)"));
}

TEST_CASE("step 2 without a drop plate is a fault") {
  json document = lab();
  document["apparatus"]["drop_plate"] = nullptr;
  document["measurements"]["step2.plateau_sag_mm"] = {{"value", 3}, {"standard_deviation", 4}};
  const Faults faults = faults_of(document);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].where == "measurements.step2.plateau_sag_mm");
  CHECK(says(faults[0], "no plate or table that drops"));
}

TEST_CASE("readings that contradict each other beyond their deviations are a fault") {
  json document = lab();
  const auto with = [&](const char* key, double value) {
    document["measurements"]["step1.height_mm"] = {{"value", 70}, {"standard_deviation", 2}};
    document["measurements"][key] = {{"value", value}, {"standard_deviation", 2}};
    return faults_of(document);
  };
  CHECK(with("step2.height_mm", 72).empty());
  CHECK(says(at(with("step2.height_mm", 74), "measurements"), "a drop does not raise a heap"));
  document = lab();
  CHECK(says(at(with("step1.height_max_mm", 60), "measurements"), "not below its height"));
  document = lab();
  document["measurements"]["step1.spread_mm"] = {{"repeats", {400, 402}}};
  CHECK(says(at(with("step2.spread_mm", 350), "measurements"), "draw a heap together"));
}

TEST_CASE("slump and height of the same heap, or no measurement at all, are faults") {
  json document = lab();
  document["measurements"]["step1.slump_mm"] = {{"value", 130}, {"standard_deviation", 5}};
  CHECK(says(at(faults_of(document), "step1.slump_mm"), "one reading"));
  document["measurements"] = json::object();
  CHECK(says(at(faults_of(document), "measurements"), "no reading"));
}

TEST_CASE("a profile becomes the outline that the heap is compared with, and its difference is measured as 0") {
  json document = lab();
  document["measurements"]["step1.profile"] =
      json::parse(R"({"points": [[-150, 5], [-80, 40], [0, 68], [90, 35], [150, 4]], "standard_deviation": 6})");
  const Result<Lab> read = lab_from_json(document, ".");
  INFO((read.ok() ? "" : message_of(read.faults())));
  REQUIRE(read.ok());
  const auto& outline = std::get<SlumpTest>(read.value().test).reading.outline_step1;
  REQUIRE(outline.size() == 5);
  CHECK(outline[1][0] == Approx(-0.08));
  CHECK(outline[1][1] == Approx(0.04));
  const Measurement& profile = read.value().measurements.back();
  CHECK(profile.reading == "step1.profile_mm");
  CHECK(profile.value == 0);
  CHECK(profile.standard_deviation == 6);
}

TEST_CASE("a profile that is too short, out of order, beside the table or above the mould is a fault with its place") {
  json document = lab();
  document["measurements"]["step1.profile"] =
      json::parse(R"({"points": [[-150, 5], [-180, 40], [0, 268], [90, 35], [450, 4]], "standard_deviation": 6})");
  document["measurements"]["step2.profile"] =
      json::parse(R"({"points": [[-150, 5], [0, 40], [150, 5]], "standard_deviation": 6})");
  const Faults faults = faults_of(document);
  CHECK(says(at(faults, "measurements.step1.profile.points[1]"), "beyond the one before"));
  CHECK(says(at(faults, "measurements.step1.profile.points[2][1]"), "268"));
  CHECK(says(at(faults, "measurements.step1.profile.points[4][0]"), "450"));
  CHECK(says(at(faults, "measurements.step2.profile.points"), "a list of 3"));
  CHECK(faults.size() == 4);
}

TEST_CASE("every measurement has its counterpart among the readings of the simulation") {
  SlumpTest test;
  test.drop.emplace().drops = 2;
  test.tilt.emplace();
  test.reading.flank.emplace();
  test.reading.flow.emplace();
  test.reading.spread_curve = {{0, 0.2}, {1, 0.3}};
  test.reading.outline_step1 = test.reading.outline_step2 = {{-0.1, 0}, {0.1, 0}};
  const std::vector<std::string> names = reading_names(test);
  const auto kinds = reading_kinds(test);
  CHECK(names.size() == kinds.size());
  for (const ReadingKind& kind : kinds) {
    INFO(kind.name);
    CHECK(kind.key.empty() == kind.measure.empty());
    if (!kind.key.empty()) CHECK(std::find(names.begin(), names.end(), kind.measure) != names.end());
    for (const Ceiling& ceiling : kind.ceilings) CHECK((ceiling.name.empty() || find_kind(kinds, ceiling.name)));
    constexpr std::array stages{"fill.", "step1.", "step2.", "after_drops.", "tilt."};
    CHECK(kind.name.starts_with(stages[kind.stage]));
  }
}

TEST_CASE("a laboratory that measured an angle of repose has it simulated, as its apparatus says or as by default") {
  json document = lab();
  const auto flank_of = [](const json& read) {
    return std::get<SlumpTest>(lab_from_json(read, {}).value().test).reading.flank;
  };
  CHECK_FALSE(flank_of(document));
  document["measurements"]["step1.angle_of_repose_deg"] = {{"value", 27}, {"standard_deviation", 1.5}};
  REQUIRE(flank_of(document));
  CHECK(flank_of(document)->lower_share == 0.2);
  document["apparatus"]["reading"]["flank"] = {{"lower_share", 0.1}, {"upper_share", 0.7}};
  CHECK(flank_of(document)->upper_share == 0.7);
  document["apparatus"]["reading"]["flank"] = {{"lower_share", 0.6}, {"upper_share", 0.65}};
  const Faults faults = faults_of(document);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].where == "apparatus.reading.flank.upper_share");
  document["apparatus"]["reading"].erase("flank");
  document["measurements"]["step1.angle_of_repose_deg"]["value"] = 91;
  REQUIRE(faults_of(document).size() == 1);
  CHECK(faults_of(document)[0].where == "measurements.step1.angle_of_repose_deg.value");
}

TEST_CASE("a time to a circle that the table does not hold is a fault of the circle, given or by default") {
  json document = lab();
  document["measurements"]["step1.t500_s"] = {{"value", 2.6}, {"standard_deviation", 0.3}};
  document["apparatus"]["lift_velocity_mm_s"] = 100;
  CHECK(faults_of(document).empty());  // a table of 700 mm
  const auto place = [&] {
    const Faults faults = faults_of(document);
    REQUIRE(faults.size() == 1);
    return faults[0].where;
  };
  document["apparatus"]["reading"]["flow"] = {{"diameter_mm", 750}};
  CHECK(place() == "apparatus.reading.flow.diameter_mm");
  document["apparatus"]["reading"]["flow"] = {{"diameter_mm", 150}};  // the mould is wider
  CHECK(place() == "apparatus.reading.flow.diameter_mm");
  document["apparatus"]["reading"].erase("flow");
  document["apparatus"]["table_length_mm"] = 450;
  document["apparatus"].erase("drop_plate");
  document["measurements"] = {{"step1.t500_s", {{"value", 2.6}, {"standard_deviation", 0.3}}}};
  CHECK(place() == "apparatus.reading.flow.diameter_mm");
}

TEST_CASE("a curve of the spread is read into SI; one that runs back in time is a fault with its place") {
  json document = lab();
  json& curve = document["measurements"]["step1.spread_curve"];
  curve = {{"points", {{0, 200}, {1.5, 310}, {4, 330}}}, {"standard_deviation", 10}};
  const auto read = lab_from_json(document, ".");
  INFO((read.ok() ? "" : message_of(read.faults())));
  REQUIRE(read.ok());
  CHECK(std::get<SlumpTest>(read.value().test).reading.spread_curve ==
        std::vector<SpreadPoint>{{0, 0.2}, {1.5, 0.31}, {4, 0.33}});
  curve["points"] = {{0, 200}, {4, 330}, {1.5, 310}};
  const Faults faults = faults_of(document);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].where.starts_with("measurements.step1.spread_curve.points"));
}

TEST_CASE("an angle of repose without the speed of the lift is noted, because it depends on it") {
  json document = lab();
  document["apparatus"] = {{"preset", "lifted-cylinder"}};
  document["grains"] = {{"distribution", "mono"}, {"radius_mm", 2.5}};
  document["measurements"] = {{"step1.angle_of_repose_deg", {{"value", 27}, {"standard_deviation", 1.5}}}};
  const auto notes = [&] { return lab_from_json(document, PASTEFIT_SOURCE_DIR "/data/lab").value().notes; };
  REQUIRE(notes().size() == 1);
  CHECK(notes()[0].find("apparatus.lift_velocity_mm_s") != std::string::npos);
  document["apparatus"]["lift_velocity_mm_s"] = 10;
  CHECK(notes().empty());
}

TEST_CASE("a height and a width that cannot hold what the mould holds are a fault of the file") {
  json document = lab();
  document["measurements"]["step1.spread_mm"] = {{"value", 205}, {"standard_deviation", 5}};
  const Faults faults = faults_of(document);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].where == "measurements");
  CHECK(says(faults[0], "step1.height_mm (70) contradicts step1.spread_mm (205)"));
}

}  // namespace
}  // namespace pastefit
