#include "calibrate/report/diagnosis.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "calibrate/base/statistics.h"
#include "calibrate/report/summary.h"

using namespace pastefit;

namespace {

Card card_named(const std::string& name) {
  auto read = read_card(std::string(PASTEFIT_SOURCE_DIR) + "/data/cards/" + name + ".json");
  REQUIRE(read.ok());
  return std::move(read).value();
}

Diagnosis of(const Card& card, std::string_view name, std::span<const StoredEvaluation> evaluations = {}) {
  const auto all = diagnoses_of(card, evaluations);
  const auto found = std::ranges::find(all, name, &Diagnosis::name);
  REQUIRE(found != all.end());
  return *found;
}

CardReading& height_of(Card& card) {
  return *std::ranges::find(card.tests[0].readings, "step1.height_mm", &CardReading::name);
}

}  // namespace

TEST_CASE("the reservations of a summary are those of the diagnoses, in their order") {
  for (const char* name : {"concrete-mix-02", "concrete-mix-20", "concrete-mix-79"}) {
    const Card card = card_named(name);
    std::vector<std::string> all;
    for (const Diagnosis& one : diagnoses_of(card))
      for (const std::string& words : one.reservations) all.push_back(words);
    CHECK(reservations_on(card) == all);
  }
  CHECK(of(card_named("concrete-mix-20"), "heaps sheared off").is_doubtful());
}

TEST_CASE("a reading beyond its tolerance is doubtful and no reservation, as the verdict states it") {
  Card card = card_named("concrete-mix-79");
  CHECK_FALSE(of(card, "readings within tolerance").is_doubtful());
  CardReading& height = height_of(card);
  height.simulated.mean = *height.measured + 2 * height.tolerance;
  const Diagnosis readings = of(card, "readings within tolerance");
  CHECK(readings.reservations.empty());
  REQUIRE(readings.notes.size() == 1);
  CHECK_THAT(readings.notes[0], Catch::Contains("step1.height_mm is off by 15") && Catch::Contains("of the 7.5"));
}

TEST_CASE("scatter is doubtful only if it exceeds the published repeatability by more than chance") {
  Card card = card_named("concrete-mix-79");
  CardReading& height = height_of(card);
  height.simulated.count = 8;
  height.simulated.standard_deviation = 9;  // published: 7.5 mm; of 8 heaps, chance explains 10.6
  CHECK_FALSE(of(card, "scatter between packings").is_doubtful());
  height.simulated.standard_deviation = 20;
  CHECK_THAT(of(card, "scatter between packings").notes.at(0), Catch::Contains("20 mm, published 7.5 mm"));
  CHECK_FALSE(of(card, "scatter of the measurement").is_doubtful());
  height.repeats = 4;
  height.standard_deviation = 30;
  CHECK_THAT(of(card, "scatter of the measurement").notes.at(0), Catch::Contains("30 mm, published 7.5 mm"));
}

TEST_CASE("the lower limit of a standard deviation is that of the chi-square distribution") {
  CHECK(least_deviation({8, 0, 1}) == Approx(std::sqrt(7 / 14.0671)));
  CHECK(least_deviation({2, 0, 1}) == Approx(std::sqrt(1 / 3.8415)).epsilon(1e-4));
}

TEST_CASE("grains too large for the opening and parameters without an interval are doubtful") {
  Card card = card_named("concrete-mix-79");
  CHECK_THAT(of(card, "number of grains").numbers, Catch::Contains("5 of the largest across"));
  CHECK(of(card, "intervals").notes.size() == card.inference.not_identified.size());
  specimen_of(card.tests[0].test).grains.largest_m *= 1.5;
  CHECK_THAT(of(card, "number of grains").notes.at(0), Catch::Contains("3.3 of the largest across"));
  card.inference = {};
  CHECK(of(card, "intervals").unknown == "not calculated");
}

TEST_CASE("simulations that created energy make the time step doubtful") {
  Card card = card_named("concrete-mix-79");
  StoredEvaluation run;
  run.run.energy_error = -0.004;
  CHECK_THAT(of(card, "time step", {&run, 1}).numbers,
             Catch::Contains("at most 0.4 % of the energy unexplained, in 1"));
  card.search.failures["energy_created"] = 3;
  CHECK_THAT(of(card, "time step").notes.at(0), Catch::Contains("3 of 30 simulations failed with energy_created"));
}

TEST_CASE("a validation test that was not predicted is doubtful, and without one nothing is known") {
  Card card = card_named("concrete-mix-79");
  CHECK_FALSE(of(card, "validation test").unknown.empty());
  card.tests.push_back(card.tests[0]);
  card.tests[1].name = "slow";
  card.tests[1].hold_out = true;
  card.tests[1].within_noise = true;
  CHECK_THAT(of(card, "validation test").numbers, Catch::Contains("slow: predicted within the noise"));
  card.tests[1].within_noise = false;
  CHECK(of(card, "validation test").is_doubtful());
}

TEST_CASE("every doubtful property says when it may be ignored and on which page it is explained, in 80 columns") {
  const auto all = diagnoses_of(card_named("concrete-mix-20"));
  const auto json = diagnosis_json(all);
  CHECK(json.size() == all.size());
  for (const auto& one : json) {
    CHECK(one["may_be_ignored"].get<std::string>().starts_with("if "));
    CHECK((one["state"] == "doubtful") == !one["found"].empty());
  }
  std::istringstream text(diagnosis_lines(all));
  for (std::string line; std::getline(text, line);) CHECK(line.size() <= 80);
}
