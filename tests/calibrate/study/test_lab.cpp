#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/study/apparatus.h"
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

/// The laboratory file with so many repeats made and sheared.
json lab_with_repeats(int made, int sheared) {
  json document = lab();
  document["repeats"] = {{"made", made}, {"sheared", sheared}};
  return document;
}

/// The measurement that `content` under `key` gives.
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

TEST_CASE("every shipped apparatus is read, and gives the readings of its steps") {
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