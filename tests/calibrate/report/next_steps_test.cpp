#include <algorithm>
#include <catch2/catch.hpp>

#include "calibrate/card/standing.h"
#include "calibrate/report/diagnosis.h"

using namespace pastefit;

namespace {

const std::string kCalibrate = "pastefit calibrate study.json --out out";

/// A confirmed card whose only fitted parameter is the friction, within wide bounds.
Card card_of_friction() {
  auto read = read_card(std::string(PASTEFIT_SOURCE_DIR) + "/data/cards/concrete-mix-79.json");
  REQUIRE(read.ok());
  Card card = std::move(read).value();
  for (Parameter& one : card.material.parameters) one.free = one.name == "friction";
  return card;
}

Parameter& friction_of(Card& card) {
  return *std::ranges::find(card.material.parameters, "friction", &Parameter::name);
}

/// The same, its height too low by two tolerances.
Card too_low() {
  Card card = card_of_friction();
  for (CardReading& one : card.tests[0].readings)
    if (one.name == "step1.height_mm") one.simulated.mean = *one.measured - 2 * one.tolerance;
  card.confirmation.error = 2;
  card.confirmation.meets_laboratory = false;
  card.confirmation.refuted = true;
  card.search.status = "unconfirmed";
  card.search.budget = 150;
  return card;
}

}  // namespace

TEST_CASE("a confirmed card has no next step") {
  CHECK(next_steps(card_of_friction(), kCalibrate, "out").empty());
  CHECK(next_step_lines("", {}).empty());
}

TEST_CASE("the first step widens the bound in the way, and the text names it beside the reading") {
  Card card = too_low();
  friction_of(card).value = friction_of(card).upper;  // 0.3, on a logarithmic scale
  const auto steps = next_steps(card, kCalibrate, "out");
  REQUIRE(steps.size() == 3);
  CHECK(steps[0].command == kCalibrate + " --resume --set parameters.friction.upper=0.6");
  CHECK(steps[1].command == kCalibrate + " --resume --budget 300");
  CHECK(steps[2].command == "pastefit doctor out");
  CHECK(in_the_way(card) == "step1.height_mm is off by 15 mm, 7.5 mm allowed; friction 0.3 is at its upper bound");
}

TEST_CASE("no step leads beyond the plausible or the admissible range of a parameter") {
  Card card = too_low();
  Parameter& friction = friction_of(card);
  friction.value = friction.upper = 0.7;
  CHECK(next_steps(card, kCalibrate, "out")[0].command == kCalibrate + " --resume --set parameters.friction.upper=1");
  friction.value = friction.upper = 1;
  CHECK(next_steps(card, kCalibrate, "out")[0].command == kCalibrate + " --resume --budget 300");
  friction.scale = Scale::linear;
  friction.upper = 0.5;
  friction.value = friction.lower = 0.05;
  CHECK(next_steps(card, kCalibrate, "out")[0].command == kCalibrate + " --resume --budget 300");
}

TEST_CASE("heaps that shear off lead to less sliding friction, or to free rolling friction") {
  Card card = card_of_friction();
  for (auto& run : card.tests[0].baseline.runs) run.readings.set("step1.lateral_shift_mm", 90);
  card.confirmation.meets_laboratory = false;
  card.confirmation.refuted = true;
  card.search.status = "unconfirmed";
  Parameter& friction = friction_of(card);
  friction.upper = 0.8;
  friction.value = 0.4;
  REQUIRE(only_heaps_refute(card));
  CHECK(next_steps(card, kCalibrate, "out")[0].command == kCalibrate + " --resume --set parameters.friction.upper=0.3");
  friction.upper = 0.3;
  friction.value = 0.2;
  CHECK(next_steps(card, kCalibrate, "out")[0].command ==
        kCalibrate + " --resume --set parameters.rolling_friction='{\"free\": [0, 0.5]}'");
}

TEST_CASE("a reading that is out of reach is no matter of more simulations") {
  Card card = too_low();
  card.search.status = "out_of_reach";
  for (const NextStep& step : next_steps(card, kCalibrate, "out"))
    CHECK_THAT(step.command, !Catch::Contains("--budget"));
}

TEST_CASE("a stopped search goes on, with a card and without one") {
  Card card = too_low();
  card.search.status = "stopped";
  CHECK(next_steps(card, kCalibrate, "out")[0].command == kCalibrate + " --resume");
  CHECK(next_steps_without_card("stopped", kCalibrate, "study.json")[0].command == kCalibrate + " --resume");
  CHECK(next_steps_without_card("failed", kCalibrate, "study.json")[0].command == "pastefit simulate study.json");
}

TEST_CASE("commands stay on one line, however long they are") {
  const std::string longest = "pastefit calibrate " + std::string(120, 'x') + ".json --out y";
  CHECK_THAT(next_step_lines("", {{"why", longest}}), Catch::Contains("    " + longest + "\n"));
}
