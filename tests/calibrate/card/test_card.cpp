#include <unistd.h>

#include <bit>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "calibrate/card/atomic_file.h"
#include "calibrate/card/card.h"
#include "calibrate/report/summary.h"
#include "calibrate/study/parameters.h"

using namespace pastefit;

namespace {

Card card() {
  Card out;
  out.title = "Mix 20";
  for (const auto& kind : parameter_kinds())
    out.parameters.push_back({std::string(kind.name), false, kind.usual, 0, 0, kind.scale});
  out.parameters[0].free = true;
  out.parameters[0].value = 3000.0 / 7;
  out.parameters[0].lower = 200;
  out.parameters[0].upper = 60000;
  std::vector<double> values;
  for (const auto& parameter : out.parameters) values.push_back(parameter.value);
  out.test = with_contact_of(out.test, values);
  out.test.drop = DropPlate{};
  out.grain_density_kg_m3 = 2238 / 0.6;
  out.observables = {{"step1.height_mm", 151.3, 2.5, 150.0, 7.5, 3, 1}, {"step1.spread_mm", 400, 4, {}, 0, 0, 0}};
  out.confirmation = {{18446744073709551615u, 9007199254740993u, 3, 4}, true, 1.3, 5, true};
  out.search = {"default", "confirmed", "It fits.", 42, {1, 2}, 60, 38, {{"never_settled", 2}}};
  auto& provenance = out.provenance;
  provenance.study_file = "study.json";
  provenance.study_hash = "0123456789abcdef";
  provenance.lab_file = "lab.json";
  provenance.lab_hash = "fedcba9876543210";
  provenance.lab.source = "UCI";
  provenance.lab.twin = true;
  provenance.program = "pastefit 0.1.0 engine 00";
  return out;
}

nlohmann::json text_and_back(const nlohmann::ordered_json& json) {
  return nlohmann::json::parse(json.dump(2));
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace

TEST_CASE("a card reads back as it was written, to the last bit") {
  const auto written = card();
  const auto document = to_json(written);
  const auto read = card_from_json(text_and_back(document));
  INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
  REQUIRE(read.ok());
  CHECK(to_json(read.value()).dump() == document.dump());
  CHECK(std::bit_cast<std::uint64_t>(read.value().test.contact.bridge.a_n_m2) ==
        std::bit_cast<std::uint64_t>(written.test.contact.bridge.a_n_m2));
  CHECK(read.value().confirmation.packings == written.confirmation.packings);
  CHECK(read.value().provenance.lab.twin);
}

TEST_CASE("a card states differences and standard errors") {
  const auto document = to_json(card());
  const auto& height = document["observables"]["step1.height_mm"];
  CHECK(height["difference"].get<double>() == Approx(1.3));
  CHECK(height["standard_error"].get<double>() == Approx(1.25));
  CHECK(document["observables"]["step1.spread_mm"]["measured"].is_null());
}

TEST_CASE("a card with faults names every one of them with its place") {
  auto document = text_and_back(to_json(card()));
  document["parameters"].erase("curvature");
  document["test"]["grains"]["radius_m"] = "8 mm";
  document["search"]["sead"] = 3;
  document["confirmation"]["packings"] = {1, -2};
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  std::string places;
  for (const auto& fault : read.faults()) places += fault.where + "\n";
  CHECK_THAT(places, Catch::Contains("parameters.curvature") && Catch::Contains("test.grains.radius_m") &&
                         Catch::Contains("search.sead") && Catch::Contains("confirmation.packings"));
  CHECK(read.faults().size() == 4);
}

TEST_CASE("a card without its test, and another kind of file, are faults") {
  auto document = text_and_back(to_json(card()));
  document.erase("test");
  CHECK_FALSE(card_from_json(document).ok());
  document["format"] = "pastefit-lab-1";
  CHECK_FALSE(card_from_json(document).ok());
  CHECK_FALSE(card_from_json(nlohmann::json(3)).ok());
  CHECK_FALSE(read_card("/nowhere/card.json").ok());
}

TEST_CASE("a file is replaced whole, and stays as it was when that fails") {
  std::string name = (std::filesystem::temp_directory_path() / "pastefit-card-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  const std::filesystem::path folder = name;
  CHECK(write_atomically(folder / "card.json", "old").empty());
  CHECK(write_atomically(folder / "card.json", "new").empty());
  CHECK(content(folder / "card.json") == "new");
  std::filesystem::create_directories(folder / "taken" / "by a folder");
  CHECK_FALSE(write_atomically(folder / "taken", "x").empty());
  CHECK_FALSE(write_atomically(folder / "missing" / "card.json", "x").empty());
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  CHECK(files == 2);  // nothing is left beside them
  std::filesystem::remove_all(folder);
}

TEST_CASE("the verdict says whether the material meets the laboratory, and whether that was confirmed") {
  auto material = card();
  CHECK_THAT(verdict_of(material), Catch::Contains("meets the laboratory") && Catch::Contains("1.30 mm"));
  material.confirmation.meets_laboratory = false;
  CHECK_THAT(verdict_of(material), Catch::Contains("does not meet"));
  material.confirmation.fresh = false;
  CHECK_THAT(verdict_of(material), Catch::Contains("Not confirmed"));
  CHECK_THAT(summary_of(material), Catch::Contains("a_n_m2") && Catch::Contains("strength_pa") &&
                                       Catch::Contains("2 failed (never_settled)") && Catch::Contains("twin"));
}
