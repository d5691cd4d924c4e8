#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "calibrate/report/summary.h"

using namespace pastefit;

namespace {

CardFile shipped(const std::string& name) {
  auto read = read_card(std::string(PASTEFIT_SOURCE_DIR) + "/data/cards/" + name + ".json");
  REQUIRE(read.ok());
  return {name, std::move(read).value()};
}

double& value_of(CardFile& one, const std::string& parameter) {
  return std::ranges::find(one.card.material.parameters, parameter, &Parameter::name)->value;
}

}  // namespace

TEST_CASE("of two cards that differ in one parameter that one is shown, and marked only outside an interval") {
  CardFile first = shipped("concrete-mix-79"), second = first;
  first.card.inference.intervals = {{"strength_pa", 500, 2000}};
  second.card.inference.intervals.clear();
  value_of(second, "strength_pa") = 1999;
  auto parameters = comparison_json(std::vector{first, second})["parameters"];
  CHECK(parameters.size() == 1);
  CHECK(parameters["strength_pa"]["excluded"] == std::vector{false, false});
  CHECK_THAT(comparison_lines(std::vector{first, second}), Catch::Contains("No card has a value outside the interval"));
  value_of(second, "strength_pa") = 2001;
  parameters = comparison_json(std::vector{first, second})["parameters"];
  CHECK(parameters["strength_pa"]["excluded"] == std::vector{false, true});
  CHECK_THAT(comparison_lines(std::vector{first, second}), Catch::Contains("2001*"));
}

TEST_CASE("a card that is not confirmed is called so beside others, and what a card lacks is a dash") {
  CardFile other = shipped("concrete-mix-79");
  other.card.tests[0].readings.pop_back();
  const std::vector cards{shipped("concrete-mix-20"), other};
  const std::string text = comparison_lines(cards);
  CHECK_THAT(text, Catch::Contains("concrete-mix-20: NOT CONFIRMED: 5 of 8 heaps sheared off"));
  const auto json = comparison_json(cards);
  CHECK(json["cards"][0]["confirmed"] == false);
  CHECK(json["cards"][1]["confirmed"] == true);
  bool lacks = false;
  for (const auto& reading : json["readings"]) lacks = lacks || reading["measured"][1].is_null();
  CHECK(lacks);
  CHECK_THAT(text, Catch::Contains(" -"));
}

TEST_CASE("any number of cards is compared in lines of 80 columns") {
  std::vector<CardFile> cards(30, shipped("concrete-mix-79"));
  for (std::size_t i = 0; i < cards.size(); ++i) value_of(cards[i], "strength_pa") = 1000 + static_cast<double>(i);
  std::istringstream text(comparison_lines(cards));
  std::size_t widest = 0;
  for (std::string line; std::getline(text, line);) widest = std::max(widest, line.size());
  CHECK(widest <= 80);
  CHECK_THAT(text.str(), Catch::Contains("D1"));
}
