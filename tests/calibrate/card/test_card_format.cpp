#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "calibrate/card/card.h"
#include "tests/calibrate/card/as_text.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;

namespace {

std::string text_of_card(const std::string& name) {
  return test::content(PASTEFIT_SOURCE_DIR "/tests/calibrate/card/" + name + ".json");
}

}  // namespace

TEST_CASE("a card is written as it was read, of one test and of several") {
  for (const char* name : {"card", "several_tests"}) {
    INFO(name);
    const auto written = nlohmann::json::parse(text_of_card(name));
    CHECK(written["format"] == "pastefit-card-" + std::to_string(kCardVersion));
    const auto read = card_from_json(written);
    REQUIRE(read.ok());
    CHECK(text_and_back(to_json(read.value())).dump(2) == written.dump(2));
  }
}

TEST_CASE("a card of version 5, which had other words for some keys, is read as the same card") {
  const auto card = nlohmann::json::parse(text_of_card("card"));
  auto document = card;
  const auto rename = [](nlohmann::json& object, const char* now, const char* before) {
    object[before] = object.at(now);
    object.erase(now);
  };
  document["format"] = "pastefit-card-5";
  rename(document["tests"][0], "readings", "observables");
  rename(document["confirmation"], "error", "misfit");
  document["confirmation"]["rejected_share_allowed"] = 0.2;
  const auto read = card_from_json(document);
  REQUIRE(read.ok());
  CHECK(read.value().confirmation.rejected_share == 0.2);
  document = card;
  document["confirmation"]["rejected_share"] = 0.2;
  CHECK(text_and_back(to_json(read.value())).dump(2) == document.dump(2));
}

TEST_CASE("a card of another version, of none, and one cut short are refused with a reason") {
  auto document = nlohmann::json::parse(text_of_card("card"));
  for (const char* format : {"pastefit-card-99", "pastefit-card-4", "pastefit-card-", "pastefit-card-6x"}) {
    document["format"] = format;
    const auto read = card_from_json(document);
    REQUIRE_FALSE(read.ok());
    REQUIRE(read.faults().size() == 1);
    CHECK(read.faults()[0].where == "format");
    CHECK_THAT(read.faults()[0].what, Catch::Contains(format));
    CHECK_THAT(read.faults()[0].remedy, Catch::Contains("the version of pastefit that wrote the card"));
  }
  document = nlohmann::json::parse(text_of_card("card"));
  document["tests"][0].erase("readings");
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  CHECK(read.faults()[0].where == "tests[0].readings");
}
