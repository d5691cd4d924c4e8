#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "calibrate/card/card.h"
#include "calibrate/card/card_versions.h"
#include "tests/calibrate/card/as_text.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;

namespace {

/// Where a value of a version 3 card stands today; "" if what it says stands elsewhere already.
std::string place_today(const std::string& place) {
  for (const auto& [before, now] : std::initializer_list<std::pair<const char*, const char*>>{
           {"/format", ""},
           {"/conditions", ""},
           {"/test/bulk_density_kg_m3", "/material/bulk_density_kg_m3"},
           {"/test/grains", "/material/grains"},
           {"/test/contact", "/material/contact"},
           {"/test_name", "/tests/0/name"},
           {"/test/", "/tests/0/test/"},
           {"/parameters", "/material/parameters"},
           {"/free", "/material/free"},
           {"/observables", "/tests/0/observables"},
           {"/baseline", "/tests/0/baseline"},
           {"/provenance/lab", "/tests/0/lab"},
           {"/further_tests/0/", "/tests/1/"},
           {"/further_tests/1/", "/tests/2/"}})
    if (place.starts_with(before)) return *now ? now + place.substr(std::string(before).size()) : "";
  return place;
}

}  // namespace

TEST_CASE("a card of every version ever written is read, and keeps its numbers") {
  const auto folder = std::filesystem::path(PASTEFIT_SOURCE_DIR) / "tests/calibrate/card/versions";
  for (int version = 1; version <= kCardVersion; ++version) {
    INFO("version " << version);
    const auto file = folder / ("card-" + std::to_string(version) + ".json");
    const auto read = read_card(file);
    INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
    REQUIRE(read.ok());
    const auto written = nlohmann::json::parse(std::ifstream(file));
    CHECK(written["format"] == "pastefit-card-" + std::to_string(version));
    auto again = text_and_back(to_json(read.value()));
    CHECK(again["format"] == "pastefit-card-" + std::to_string(kCardVersion));
    const auto before = written.flatten(), flat = again.flatten();
    for (const auto& [place, value] : before.items()) {
      INFO(place);
      const std::string now = version < 4 ? place_today(place) : place;
      // What was said in mm or of the offset is checked below; an empty baseline is none.
      if (now.empty() || now == "/format" || (version < 5 && place.find("offset") != std::string::npos) ||
          (version < 3 && place.ends_with("_mm")) || value.is_null() || value.empty())
        continue;
      CHECK(flat.value(now, nlohmann::json("absent")) == value);
    }
    CHECK(again["confirmation"]["misfit"].get<double>() * 5 == Approx(0.040223408152215256));
    for (const auto& [name, observable] : again["tests"][0]["observables"].items())
      CHECK(observable.value("tolerance", 0.0) == (observable["measured"].is_null() ? 0 : 5));
  }
}

TEST_CASE("the offset of older cards becomes a share of their own rupture gap, and acts as before") {
  const auto file = std::filesystem::path(PASTEFIT_SOURCE_DIR) / "tests/calibrate/card/versions/card-4.json";
  auto document = nlohmann::json::parse(test::content(file));
  auto& parameters = document["material"]["parameters"];
  auto& bridge = document["material"]["contact"]["bridge"];
  const double radius = document["material"]["grains"]["radius_m"], gap = parameters["rupture_gap_ratio"];
  const auto today = [&] {
    const auto read = card_from_json(document);
    INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
    REQUIRE(read.ok());
    return text_and_back(to_json(read.value()))["material"];
  };
  const double offset = parameters["offset_ratio"];
  REQUIRE(2 * offset < gap);
  auto material = today();
  CHECK(material["parameters"]["formation_ratio"].get<double>() == Approx(2 * offset / gap));
  CHECK(material["contact"]["bridge"]["offset_m"] == bridge["offset_m"]);
  CHECK(material["free"]["formation_ratio"]["upper"] == 1);
  // Shells that meet beyond the gap at which the bridge ruptures.
  parameters["offset_ratio"] = 0.9 * gap;
  bridge["offset_m"] = 0.9 * gap * radius;
  material = today();
  CHECK(material["parameters"]["formation_ratio"] == 1);
  CHECK(material["contact"]["bridge"]["offset_m"].get<double>() == Approx(0.5 * gap * radius));
  // The offset bounded a bridge that forms by touch.
  parameters["offset_ratio"] = 0.3 * gap;
  bridge["formation"] = "touch";
  bridge["offset_m"] = 0.3 * gap * radius;
  for (const auto& [key, power] : {std::pair{"d_c_m", 1}, {"b_n_m", -1}, {"a_n_m2", -2}})
    bridge[key] = bridge[key].get<double>() * std::pow(0.6, power);
  material = today();
  CHECK(material["parameters"]["rupture_gap_ratio"].get<double>() == Approx(0.6 * gap));
  CHECK_FALSE(material["free"].contains("formation_ratio"));
}

TEST_CASE("a card of this version is written as it was read") {
  const std::string folder = PASTEFIT_SOURCE_DIR "/tests/calibrate/card/versions/";
  const auto file = folder + "card-" + std::to_string(kCardVersion) + ".json";
  const auto read = read_card(file);
  REQUIRE(read.ok());
  CHECK(text_and_back(to_json(read.value())).dump(2) == nlohmann::json::parse(test::content(file)).dump(2));
}

TEST_CASE("a card of several tests of version 3 becomes a material and its tests, to the last bit") {
  const auto file = std::filesystem::path(PASTEFIT_SOURCE_DIR) / "tests/calibrate/card/versions/card-3-several.json";
  const auto read = read_card(file);
  INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
  REQUIRE(read.ok());
  const auto written = nlohmann::json::parse(test::content(file));
  const auto again = text_and_back(to_json(read.value()));
  REQUIRE(again["tests"].size() == 3);
  // What a test has of the material is said once.
  for (const int same : {0, 1})
    for (const auto* key : {"bulk_density_kg_m3", "grains", "contact"})
      CHECK_FALSE(again["tests"][same]["test"].contains(key));
  CHECK(again["tests"][2]["test"]["grains"]["radius_m"] == 0.014);
  CHECK(again["material"]["grains"]["radius_m"] == 0.012);
  for (std::size_t i = 0; i < 3; ++i) {
    INFO("test " << i);
    auto before = i == 0 ? written["test"] : written["further_tests"][i - 1]["test"];
    auto now = to_json(read.value().tests[i].test);
    for (auto* const test : {&before, &now})
      (*test)["contact"]["bridge"].erase("offset_m");  // the rupture gap bounds it
    CHECK(now == before);
    const auto& readings = i == 0 ? written["observables"] : written["further_tests"][i - 1]["observables"];
    CHECK(again["tests"][i]["observables"] == readings);
    const auto& baseline = i == 0 ? written["baseline"] : written["further_tests"][i - 1]["baseline"];
    CHECK(again["tests"][i]["baseline"] == baseline);
  }
  CHECK(read.value().tests[0].name == "slow");
  CHECK(read.value().tests[2].hold_out);
  CHECK(read.value().tests[2].within_noise == true);
  CHECK(read.value().tests[0].lab_hash == written["provenance"]["lab_hash"]);
  CHECK(text_and_back(to_json(card_from_json(again).value())) == again);
}

TEST_CASE("a card of a newer version, of none, and one cut short are refused with a reason") {
  const std::string folder = PASTEFIT_SOURCE_DIR "/tests/calibrate/card/versions/";
  auto document = nlohmann::json::parse(test::content(folder + "card-" + std::to_string(kCardVersion) + ".json"));
  document["format"] = "pastefit-card-99";
  auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  CHECK_THAT(read.faults()[0].remedy, Catch::Contains("newer"));
  for (const auto* format : {"pastefit-card-", "pastefit-card-0", "pastefit-card-2x", "pastefit-card--1"}) {
    document["format"] = format;
    CHECK_FALSE(card_from_json(document).ok());
  }
  document = nlohmann::json::parse(test::content(folder + "card-2.json"));
  document.erase("observables");
  read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  CHECK(read.faults()[0].where == "tests[0].observables");
}
