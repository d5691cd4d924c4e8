#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/base/content_hash.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/lab.h"
#include "core/apparatus/slump/slump_readings.h"
#include "core/apparatus/slump/slump_test.h"
#include "tests/calibrate/files.h"

namespace pastefit {
namespace {

using nlohmann::json;
using test::at;
using test::says;

json lab() {
  return json::parse(R"({
    "format": "pastefit-lab-1", "title": "a paste",
    "provenance": {"source": "our laboratory"},
    "apparatus": {
      "mould": {"base_diameter_mm": 200, "top_diameter_mm": 130, "height_mm": 200},
      "table_length_mm": 700, "lift_velocity_mm_s": 100,
      "drop_plate": {"length_mm": 700, "mass_kg": 16, "lift_height_mm": 40},
      "reading": {"height": "highest"}},
    "material": {"bulk_density_kg_m3": 2000},
    "grains": {"distribution": "mono", "radius_mm": 8},
    "measurements": {"step1.height_mm": {"value": 70, "standard_deviation": 5}}})");
}

Faults faults_of(const json& document) {
  const Result<Lab> read = lab_from_json(document, ".");
  return read.ok() ? Faults{} : read.faults();
}

/// The laboratory file with so many repeats made and sheared.
json lab_with_repeats(int made, int sheared) {
  json document = lab();
  document["repeats"] = {{"made", made}, {"sheared", sheared}};
  return document;
}

/// The measurement that `content` under `key` gives.
Measurement measured(const std::string& key, const char* content) {
  json document = lab();
  document["measurements"] = {{key, json::parse(content)}};
  const Result<Lab> read = lab_from_json(document, ".");
  INFO((read.ok() ? "" : message_of(read.faults())));
  REQUIRE(read.ok());
  REQUIRE(read.value().measurements.size() == 1);
  return read.value().measurements[0];
}

TEST_CASE("a laboratory file with an apparatus of its own is read into SI") {
  const Result<Lab> read = lab_from_json(lab(), ".");
  REQUIRE(read.ok());
  const auto& test = std::get<SlumpTest>(read.value().test);
  CHECK(test.mould.base_radius_m == 0.1);
  CHECK(test.mould.top_radius_m == 0.065);
  CHECK(test.mould.height_m == 0.2);
  CHECK(test.lift_velocity_m_s == 0.1);
  CHECK(test.drop.value().lift_height_m == 0.04);
  CHECK(test.drop.value().lift_duration_s == DropPlate{}.lift_duration_s);
  CHECK(test.reading.height == HeightReading::highest);
  CHECK(test.grains.radius_m == 0.008);
  CHECK(test.contact.bridge.shape == BridgeShape::polynomial);
  CHECK(read.value().measurements[0].repeats == 1);
}

TEST_CASE("every shipped apparatus is read, and gives the observables of its steps") {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PASTEFIT_SOURCE_DIR "/data/apparatus")) {
    if (entry.path().extension() != ".json") continue;
    const Result<Apparatus> apparatus = read_apparatus_file(entry.path());
    INFO((apparatus.ok() ? "" : message_of(apparatus.faults())));
    CHECK(apparatus.ok());
    ++read;
  }
  CHECK(read >= 5);
}

TEST_CASE("the EN 12350-5 preset holds the volume and the plate of that standard") {
  const Result<Apparatus> apparatus = read_apparatus_file(PASTEFIT_SOURCE_DIR "/data/apparatus/en12350-5.json");
  REQUIRE(apparatus.ok());
  CHECK(1000 * volume_m3(std::get<SlumpTest>(apparatus.value().test).mould) == Approx(4.341).epsilon(1e-3));
  CHECK(std::get<SlumpTest>(apparatus.value().test).drop.value().mass_kg == 16);
}

TEST_CASE("own keys differ from the preset, the rest is the preset's") {
  json document = lab();
  document["apparatus"] = {
      {"preset", "en12350-5"}, {"mould", {{"height_mm", 201}}}, {"drop_plate", {{"mass_kg", 15.8}}}};
  const Result<Lab> read = lab_from_json(document, ".");
  REQUIRE(read.ok());
  CHECK(std::get<SlumpTest>(read.value().test).mould.height_m == 0.201);
  CHECK(std::get<SlumpTest>(read.value().test).mould.top_radius_m == 0.065);
  CHECK(std::get<SlumpTest>(read.value().test).drop.value().mass_kg == 15.8);
  CHECK(std::get<SlumpTest>(read.value().test).drop.value().length_m == 0.7);
  document["apparatus"]["drop_plate"] = nullptr;
  CHECK_FALSE(std::get<SlumpTest>(lab_from_json(document, ".").value().test).drop);
}

TEST_CASE("the preset beside the laboratory file goes before the installed one") {
  const test::Folder folder;
  std::filesystem::create_directory(folder.path() / "apparatus");
  std::filesystem::create_directory(folder.path() / "lab");
  json apparatus = json::parse(std::ifstream(PASTEFIT_SOURCE_DIR "/data/apparatus/en12350-5.json"));
  apparatus["apparatus"]["mould"]["height_mm"] = 199;
  folder.write("apparatus/en12350-5.json", apparatus.dump());
  json document = lab();
  document["apparatus"] = {{"preset", "en12350-5"}};
  CHECK(std::get<SlumpTest>(lab_from_json(document, folder.path() / "lab").value().test).mould.height_m == 0.199);
  CHECK(std::get<SlumpTest>(lab_from_json(document, folder.path()).value().test).mould.height_m == 0.2);
}

TEST_CASE("an unknown preset is answered with the nearest one") {
  json document = lab();
  document["apparatus"]["preset"] = "abram";
  CHECK(says(at(faults_of(document), "apparatus.preset"), "did you mean \"abrams\"?"));
  document["apparatus"]["preset"] = "../lab/x";
  CHECK(says(at(faults_of(document), "apparatus.preset"), "presets: "));
}

TEST_CASE("the faults of a broken preset are named with its file") {
  const test::Folder folder;
  std::filesystem::create_directory(folder.path() / "apparatus");
  std::filesystem::create_directory(folder.path() / "lab");
  folder.write("apparatus/mine.json", R"({"format": "pastefit-rig-1", "title": 3})");
  json document = lab();
  document["apparatus"] = {{"preset", "mine"}};
  const Result<Lab> read = lab_from_json(document, folder.path() / "lab");
  REQUIRE_FALSE(read.ok());
  CHECK(says(at(read.faults(), "mine.json: title"), "a text in quotes"));
  CHECK(says(at(read.faults(), "mine.json: apparatus"), "is missing"));
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
  CHECK(reading.observable == "step1.height_mm");
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
  CHECK(says(faults[0], "no drop plate"));
}

TEST_CASE("readings that contradict each other beyond their deviations are a fault") {
  json document = lab();
  const auto with = [&](const char* key, double value) {
    document["measurements"]["step1.height_mm"] = {{"value", 70}, {"standard_deviation", 2}};
    document["measurements"][key] = {{"value", value}, {"standard_deviation", 2}};
    return faults_of(document);
  };
  CHECK(with("step2.height_mm", 77).empty());
  CHECK(says(at(with("step2.height_mm", 79), "measurements"), "a drop does not raise a heap"));
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
  CHECK(profile.observable == "step1.profile_mm");
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

TEST_CASE("grains state what their distribution needs, and no more") {
  json document = lab();
  document["grains"] = {{"distribution", "uniform"}, {"smallest_mm", 6}, {"largest_mm", 10}};
  const Result<Lab> uniform = lab_from_json(document, ".");
  REQUIRE(uniform.ok());
  CHECK(specimen_of(uniform.value().test).grains.radius_m ==
        Approx(0.008));  // the mean, to which the contact law refers
  document["grains"]["radius_mm"] = 8;
  CHECK(says(at(faults_of(document), "grains.radius_mm"), "leave it out"));
  document["grains"] = {{"distribution", "normal"}, {"radius_mm", 8}, {"smallest_mm", 9}, {"largest_mm", 10}};
  CHECK(says(at(faults_of(document), "grains.standard_deviation_mm"), "missing"));
  document["grains"]["standard_deviation_mm"] = 1;
  CHECK(says(at(faults_of(document), "grains.smallest_mm"), "not in order"));
}

TEST_CASE("what makes no test is named in the words of the file") {
  json document = lab();
  document["apparatus"]["mould"]["height_mm"] = 20;  // of grains of 16 mm
  document["measurements"]["step1.height_mm"]["value"] = 10;
  document["apparatus"]["mold"] = 1;  // an unknown key does not hide it
  const Faults faults = faults_of(document);
  REQUIRE(faults.size() == 2);
  CHECK(says(at(faults, "grains.radius_mm"), "is 8 mm (largest), but the mould is only 20 mm across"));
}

TEST_CASE("every fault of a file is named at once") {
  json document = lab();
  document.erase("title");
  document["provenance"]["sorce"] = document["provenance"]["source"];
  document["provenance"].erase("source");
  document["apparatus"]["mould"]["height_mm"] = "200";
  document["apparatus"]["lift_velocity_mm_s"] = -100;
  document["material"]["bulk_density"] = 2;
  document["grains"]["radius_mm"] = nullptr;
  document["measurements"]["step1.hight_mm"] = json::object();
  const Faults faults = faults_of(document);
  INFO(message_of(faults));
  CHECK(faults.size() == 8);
  CHECK(says(at(faults, "title"), "missing"));
  CHECK(says(at(faults, "provenance.source"), "missing"));
  CHECK(says(at(faults, "provenance.sorce"), "did you mean \"source\"?"));
  CHECK(says(at(faults, "apparatus.mould.height_mm"), "write 200, without quotes"));
  CHECK(says(at(faults, "apparatus.lift_velocity_mm_s"), "is -100"));
  CHECK(says(at(faults, "material.bulk_density"), "did you mean \"bulk_density_kg_m3\"?"));
  CHECK(says(at(faults, "grains.radius_mm"), "is null"));
  CHECK(says(at(faults, "measurements.step1.hight_mm"), "did you mean \"step1.height_mm\"?"));
}

TEST_CASE("a value in the place of an object is answered with what to write") {
  json document = lab();
  document["material"] = 2300;
  document["apparatus"] = "abrams";
  document["grains"] = 8;
  document["provenance"] = nullptr;
  const Faults faults = faults_of(document);
  CHECK(faults.size() == 4);
  CHECK(says(at(faults, "material"), R"(write {"bulk_density_kg_m3": 2300})"));
  CHECK(says(at(faults, "apparatus"), R"("preset")"));
  CHECK(says(at(faults, "grains"), R"("smallest_mm": 6)"));
  CHECK(says(at(faults, "provenance"), R"("source")"));
}

TEST_CASE("a file of another kind is one fault, not a list of unknown keys") {
  json document = lab();
  document["format"] = "pastefit-study-1";
  const Faults faults = faults_of(document);
  REQUIRE(faults.size() == 1);
  CHECK(says(faults[0], "pastefit-lab-1"));
  CHECK(faults_of(json::array()).size() == 1);
}

TEST_CASE("faults of a file carry its path, and a broken file one place") {
  const test::Folder folder;
  json document = lab();
  document.erase("title");
  const auto missing = read_lab(folder.write("a.json", document.dump()));
  REQUIRE_FALSE(missing.ok());
  CHECK(missing.faults()[0].where == (folder.path() / "a.json").string() + ": title");
  const auto broken = read_lab(folder.write("b.json", "{\n]"));
  REQUIRE_FALSE(broken.ok());
  CHECK(broken.faults()[0].where == (folder.path() / "b.json").string() + ": line 2, column 1");
  const auto twice =
      read_lab(folder.write("c.json", test::with(lab().dump(), "\"title\"", "\"title\":\"b\",\"title\"")));
  REQUIRE_FALSE(twice.ok());
  CHECK(says(twice.faults()[0], "stands twice"));
}

TEST_CASE("the hash follows content and preset, not comments and white space") {
  CHECK(content_hash("") == "cbf29ce484222325");
  CHECK(content_hash("a") == "af63dc4c8601ec8c");  // published test vector
  const test::Folder folder;
  const auto hash = [&](const std::string& text) { return read_lab(folder.write("lab.json", text)).value().hash; };
  const std::string first = hash(lab().dump());
  CHECK(hash("// a comment\n" + lab().dump(4)) == first);
  json changed = lab();
  changed["measurements"]["step1.height_mm"]["value"] = 71;
  CHECK(hash(changed.dump()) != first);
}

TEST_CASE("every measurement has its counterpart among the readings of the simulation") {
  SlumpTest test;
  test.drop.emplace().drops = 2;
  test.reading.flank.emplace();
  test.reading.flow.emplace();
  test.reading.spread_curve = {{0, 0.2}, {1, 0.3}};
  test.reading.outline_step1 = test.reading.outline_step2 = {{-0.1, 0}, {0.1, 0}};
  const std::vector<std::string> names = observable_names(test);
  const auto kinds = reading_kinds(test);
  CHECK(names.size() == kinds.size());
  for (const ReadingKind& kind : kinds) {
    INFO(kind.name);
    CHECK(kind.key.empty() == kind.measure.empty());
    if (!kind.key.empty()) CHECK(std::find(names.begin(), names.end(), kind.measure) != names.end());
    for (const Ceiling& ceiling : kind.ceilings) CHECK((ceiling.name.empty() || find_kind(kinds, ceiling.name)));
    constexpr std::array stages{"fill.", "step1.", "step2.", "after_drops."};
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

TEST_CASE("a laboratory file says how many of its heaps sheared off") {
  const Result<Lab> read = lab_from_json(lab_with_repeats(4, 1), ".");
  REQUIRE(read.ok());
  CHECK(read.value().repeats.sheared_share() == 0.25);
  CHECK(read.value().notes == std::vector<std::string>{"1 of 4 heaps of the laboratory sheared off"});
  CHECK(lab_from_json(lab(), ".").value().repeats.sheared_share() == 0);
}

TEST_CASE("more heaps sheared than made, all of them, or readings of heaps that did not stand are faults") {
  CHECK(says(at(faults_of(lab_with_repeats(3, 4)), "repeats.sheared"), "4 of 3"));
  CHECK(says(at(faults_of(lab_with_repeats(3, 3)), "repeats.sheared"), "no height"));
  json document = lab_with_repeats(4, 2);
  document["measurements"] = {{"step1.height_mm", {{"repeats", {70, 72, 75}}}}};
  CHECK(says(at(faults_of(document), "measurements.step1.height_mm"), "only 2 heaps stood"));
  document["repeats"]["sheared"] = 1;
  CHECK(faults_of(document).empty());
}

TEST_CASE("a laboratory file names its mix, and a name or a value that is none is a fault") {
  json document = lab();
  document["mix"] = {{"water_kg_m3", 180}, {"cement_kg_m3", 320.5}};
  const Result<Lab> read = lab_from_json(document, ".");
  REQUIRE(read.ok());
  REQUIRE(read.value().mix.size() == 2);
  CHECK(read.value().mix[0].name == "cement_kg_m3");
  CHECK(read.value().mix[1].value == 180);
  document["mix"] = {{"water", "180"}, {"Water kg", 180}};
  const Faults faults = faults_of(document);
  CHECK(faults.size() == 2);
  CHECK(says(at(faults, "mix.Water kg"), "water_kg_m3"));
  CHECK(says(at(faults, "mix.water"), "180"));
  document["mix"] = 180;
  CHECK(says(at(faults_of(document), "mix"), "water_kg_m3"));
}

}  // namespace
}  // namespace pastefit
