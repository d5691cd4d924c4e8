#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calibrate/study/apparatus.h"
#include "calibrate/study/lab.h"
#include "calibrate/study/slump_sheet.h"
#include "calibrate/study/tests.h"
#include "core/apparatus/slump/slump_test.h"
#include "tests/calibrate/files.h"
#include "tests/calibrate/study/desk.h"

namespace pastefit {
namespace {

using nlohmann::json;

json lab_on(const char* preset) {
  json document = json::parse(R"({"format": "pastefit-lab-1", "title": "a mortar",
    "provenance": {"source": "our laboratory"}, "material": {"bulk_density_kg_m3": 2100},
    "measurements": {"step1.spread_mm": {"value": 130, "standard_deviation": 4}}})");
  document["apparatus"] = {{"preset", preset}};
  return document;
}

std::string faults_in(const json& document) {
  const Result<Lab> read = lab_from_json(document, ".");
  return read.ok() ? "" : message_of(read.faults());
}

bool holds(const std::vector<std::string>& notes, const char* words) {
  return std::ranges::any_of(notes, [&](const std::string& note) { return note.find(words) != note.npos; });
}

}  // namespace

TEST_CASE("the jolting tables have the drops and the rhythm of their standards") {
  struct Row {
    const char* preset;
    double volume_l, drop_mm, whole_s;
    int drops;
  };
  for (const Row& row : {Row{"haegermann-table", 0.344, 10, 15, 15}, Row{"astm-c1437", 0.287, 12.7, 15, 25}}) {
    INFO(row.preset);
    const Result<Apparatus> read = find_preset(row.preset, ".");
    REQUIRE(read.ok());
    const auto& test = std::get<SlumpTest>(read.value().test);
    CHECK(1e3 * volume_m3(test.mould) == Approx(row.volume_l).epsilon(2e-3));
    REQUIRE(test.drop);
    CHECK(test.drop->motion == TableMotion::vertical);
    CHECK(1e3 * test.drop->lift_height_m == Approx(row.drop_mm));
    CHECK(test.drop->drops == row.drops);
    CHECK(test.drop->drops * test.drop->period_s == Approx(row.whole_s));
    CHECK(test.drop->length_m == test.table_length_m);
    REQUIRE(read.value().readings.size() == 2);
    CHECK(read.value().readings[1].reading == "after_drops.spread_mm");
    CHECK(grains_needed(read.value().test) > kFewGrains);
  }
}

TEST_CASE("readings after drops need a table, and one that drops more than once; each fault names the remedy") {
  json document = lab_on("haegermann");
  document["measurements"]["after_drops.spread_mm"] = {{"value", 160}, {"standard_deviation", 5}};
  CHECK(test::says(test::at(lab_from_json(document, ".").faults(), "measurements.after_drops.spread_mm"),
                   "no plate or table that drops"));
  document = lab_on("en12350-5");
  document["measurements"] = {{"after_drops.spread_mm", {{"value", 400}, {"standard_deviation", 15}}}};
  CHECK(test::says(test::at(lab_from_json(document, ".").faults(), "measurements.after_drops.spread_mm"),
                   "dropped once"));
  document["apparatus"]["drop_plate"] = {{"drops", 15}};
  CHECK(faults_in(document).empty());
  document["apparatus"]["drop_plate"]["drops"] = 101;
  CHECK(test::says(test::at(lab_from_json(document, ".").faults(), "apparatus.drop_plate.drops"), "101"));
  document["apparatus"]["drop_plate"] = {{"drops", 15}, {"period_s", 0.4}};
  CHECK(
      test::says(test::at(lab_from_json(document, ".").faults(), "apparatus.drop_plate.period_s"), "moves for 0.574"));
  document["apparatus"]["drop_plate"] = {{"length_mm", 100}};
  CHECK(test::says(test::at(lab_from_json(document, ".").faults(), "apparatus.drop_plate.length_mm"), "100 mm"));
  document = lab_on("haegermann");
  document["apparatus"]["drop_plate"] = {{"drops", 15}};
  CHECK(test::says(test::at(lab_from_json(document, ".").faults(), "apparatus.drop_plate.length_mm"), "missing"));
  document = lab_on("haegermann-table");
  document["measurements"]["step2.plateau_sag_mm"] = {{"value", 2}, {"standard_deviation", 1}};
  CHECK(test::says(test::at(lab_from_json(document, ".").faults(), "measurements.step2.plateau_sag_mm"), "upright"));
}

TEST_CASE("a heap is not narrower after the drops than before them") {
  json document = lab_on("haegermann-table");
  document["measurements"]["after_drops.spread_mm"] = {{"value", 110}, {"standard_deviation", 4}};
  CHECK(faults_in(document).find("a drop does not draw a heap together") != std::string::npos);
}

TEST_CASE("a preset's caution is a note of every laboratory file that names it, until a table is added") {
  json document = lab_on("haegermann");
  CHECK(holds(lab_from_json(document, ".").value().notes, "no strokes"));
  document["apparatus"]["drop_plate"] = {
      {"length_mm", 300}, {"mass_kg", 4}, {"lift_height_mm", 10}, {"motion", "vertical"}, {"drops", 15}};
  REQUIRE(faults_in(document).empty());
  CHECK_FALSE(holds(lab_from_json(document, ".").value().notes, "no strokes"));
  CHECK_FALSE(holds(lab_from_json(lab_on("haegermann-table"), ".").value().notes, "no strokes"));
}

TEST_CASE("what a preset says of its readings does not change who it is") {
  json document = json::parse(std::ifstream(PASTEFIT_SOURCE_DIR "/data/apparatus/haegermann.json"));
  const std::string content = apparatus_from_json(document).value().content;
  document.erase("readings");
  document.erase("caution");
  CHECK(apparatus_from_json(document).value().content == content);
  document["apparatus"]["lift_velocity_mm_s"] = 60;
  CHECK(apparatus_from_json(document).value().content != content);
}

TEST_CASE("a faulty customary reading of a preset is a fault of its place") {
  json document = json::parse(std::ifstream(PASTEFIT_SOURCE_DIR "/data/apparatus/haegermann.json"));
  document["readings"]["after_drops.spread_mm"] = {{"value", 160}, {"standard_deviation", 5}};
  document["readings"]["step1.spread_mm"] = {{"value", 1300}, {"standard_deviation", 5}};
  document["readings"]["step1.width_mm"] = {{"value", 130}, {"standard_deviation", 5}};
  const Faults faults = apparatus_from_json(document).faults();
  CHECK(test::says(test::at(faults, "readings.after_drops.spread_mm"), "no plate or table that drops"));
  CHECK(test::says(test::at(faults, "readings.step1.spread_mm.value"), "1300"));
  CHECK_FALSE(test::at(faults, "readings.step1.width_mm").what.empty());
}

TEST_CASE("the template of every preset is a laboratory file on its table, with its grains and customary readings") {
  for (const char* preset :
       {"abrams", "abrams-en", "en12350-5", "haegermann", "haegermann-table", "astm-c1437", "mini-cone"}) {
    INFO(preset);
    const Result<std::string> text = slump_lab_template(preset, ".");
    REQUIRE(text.ok());
    const json document = json::parse(text.value(), nullptr, true, true);
    INFO(faults_in(document));
    const Result<Lab> lab = lab_from_json(document, ".");
    REQUIRE(lab.ok());
    const Apparatus own = find_preset(preset, ".").value();
    const auto &test = std::get<SlumpTest>(lab.value().test), &wanted = std::get<SlumpTest>(own.test);
    CHECK(test.mould.height_m == wanted.mould.height_m);
    CHECK(test.lift_velocity_m_s == Approx(wanted.lift_velocity_m_s));
    CHECK(test.drop.has_value() == wanted.drop.has_value());
    CHECK(test.grains.radius_m == Approx(wanted.grains.radius_m));
    REQUIRE(lab.value().measurements.size() == own.readings.size());
    CHECK((text.value().find("has no strokes") != std::string::npos) == (preset == std::string("haegermann")));
  }
  CHECK_FALSE(slump_lab_template("no-such-mould", ".").ok());
}

TEST_CASE("grains too few and tolerances too wide are warnings that name both, and the shipped template has neither") {
  const test::Desk desk;
  const Study usual = desk.read(test::Desk::study()).value();
  CHECK(notes_on_tolerances(usual).empty());
  CHECK(note_on_grain_count(usual.tests[0].lab.test).empty());

  // A Hägermann cone with the grains and the deviation of a tall cone.
  json coarse = lab_on("haegermann");
  coarse["grains"] = {{"distribution", "mono"}, {"radius_mm", 8}};
  coarse["measurements"] = {{"step1.spread_mm", {{"value", 130}, {"standard_deviation", 25}}},
                            {"step1.height_mm", {{"value", 38}, {"standard_deviation", 1.5}}}};
  desk.folder().write("lab.json", coarse.dump());
  const Study study = desk.read(test::Desk::study()).value();
  CHECK(holds(study.tests[0].lab.notes, "fewer than 500"));
  const auto notes = notes_on_tolerances(study);
  REQUIRE(notes.size() == 1);
  for (const char* words : {"step1.spread_mm", "within 25", "4.6 standard deviations", "grains of 8 mm"})
    CHECK(notes[0].find(words) != std::string::npos);

  json own = test::Desk::study();
  own["tolerances"] = {{"step1.spread_mm", 16}};  // of a published 5.4
  CHECK(notes_on_tolerances(desk.read(own).value()).empty());
  own["weights"] = {{"step1.spread_mm", 0}};
  own["tolerances"] = {{"step1.spread_mm", 30}};
  CHECK(notes_on_tolerances(desk.read(own).value()).empty());  // it is not fitted
}

}  // namespace pastefit
