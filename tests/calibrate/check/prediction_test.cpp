#include "calibrate/check/prediction.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "calibrate/study/parameters.h"

using namespace pastefit;

namespace {

/// Heaps whose height goes with the friction of their grains, 1 mm higher or lower from packing to packing.
CheckEngine made_up() {
  CheckEngine engine;
  engine.prepare = [](const Test&, const RunOptions&) { return std::make_shared<const Packing>(); };
  engine.run = [](const Test& test, const RunOptions&) {
    const Specimen& specimen = specimen_of(test);
    Outcome outcome;
    outcome.readings.set("step1.height_mm",
                         100 + 100 * specimen.contact.friction + (specimen.packing_seed % 2 ? 1 : -1));
    return outcome;
  };
  return engine;
}

}  // namespace

TEST_CASE("a predicted band reaches from the lowest to the highest material, wider by the scatter of one heap") {
  const auto card = read_card(PASTEFIT_SOURCE_DIR "/data/cards/concrete-mix-79.json");
  REQUIRE(card.ok());
  std::vector<std::vector<double>> materials(2, values_of(card.value().material));
  const auto friction = static_cast<std::size_t>(
      std::ranges::find(parameter_kinds(), "friction", &ParameterKind::name) - parameter_kinds().begin());
  materials[0][friction] = 0.1;
  materials[1][friction] = 0.3;
  const Test test = card.value().tests.front().test;
  std::vector<Measurement> measured(1);
  measured[0].reading = "step1.height_mm";
  const auto predicted = [&](double value) {
    measured[0].value = value;
    const auto found = predict(card.value(), materials, test, measured, 4, 1, made_up());
    REQUIRE(found.ok());
    REQUIRE(found.value().readings.size() == 1);
    CHECK(found.value().heaps == 8);
    return found.value().readings[0];
  };
  const ReadingPrediction height = predicted(120);
  const double scatter = 1.943180 * std::sqrt(4.0 / 3);  // t(0.95; 6), from a table, times the pooled deviation
  CHECK(height.of_materials == std::vector<double>{110, 130});
  CHECK(height.mean == 120);
  CHECK(height.lower == Approx(110 - scatter).epsilon(1e-6));
  CHECK(height.upper == Approx(130 + scatter).epsilon(1e-6));
  CHECK(height.is_within());
  // Of a normal distribution with the variance of both means, 200, after one test of a deviation of 7.5 mm, as
  // published.
  CHECK(height.of_test == Approx(7.5));
  CHECK(height.width_left() ==
        Approx(7.5 / std::sqrt(7.5 * 7.5 + 200 - 4.0 / 3 / 4)));  // less that of a mean of four heaps
  ReadingPrediction same;
  same.of_materials = {3, 3};
  CHECK(same.width_left() == 1);
  CHECK_FALSE(predicted(130 + 1.01 * scatter).is_within());
  CHECK_FALSE(predicted(110 - 1.01 * scatter).is_within());
}

TEST_CASE("of heaps that slide off the table a prediction has no later readings, and says how many they are") {
  const auto card = read_card(PASTEFIT_SOURCE_DIR "/data/cards/concrete-mix-79.json");
  REQUIRE(card.ok());
  CheckEngine engine = made_up();
  engine.run = [run = engine.run](const Test& test, const RunOptions& options) {
    Outcome outcome = run(test, options);
    const bool slides = specimen_of(test).contact.friction < 0.2;
    outcome.readings.set("step2.spilled_share", slides ? 0.9 : 0.02);
    outcome.readings.set("step2.height_mm", slides ? 8 : 80);
    return outcome;
  };
  std::vector<std::vector<double>> materials(2, values_of(card.value().material));
  const auto friction = static_cast<std::size_t>(
      std::ranges::find(parameter_kinds(), "friction", &ParameterKind::name) - parameter_kinds().begin());
  materials[0][friction] = 0.1;
  materials[1][friction] = 0.3;
  SlumpTest test = std::get<SlumpTest>(card.value().tests.front().test);
  test.drop = DropPlate{};
  const std::vector<Measurement> measured{{"step1.height_mm", 120, 1, 1}, {"step2.height_mm", 80, 1, 1}};
  const auto found = predict(card.value(), materials, test, measured, 4, 1, engine);
  REQUIRE(found.ok());
  CHECK(found.value().spilled == 4);
  const auto& readings = found.value().readings;
  const auto height2 = std::ranges::find(readings, "step2.height_mm", &ReadingPrediction::name);
  REQUIRE(height2 != readings.end());
  CHECK(height2->of_materials == std::vector<double>{80});
  CHECK(std::ranges::find(readings, "step1.height_mm", &ReadingPrediction::name)->of_materials.size() == 2);
}

TEST_CASE("a heap that never comes to rest is counted and left out, and only all of them are an error") {
  const auto card = read_card(PASTEFIT_SOURCE_DIR "/data/cards/concrete-mix-79.json");
  REQUIRE(card.ok());
  const std::vector<std::vector<double>> materials(2, values_of(card.value().material));
  const Test test = card.value().tests.front().test;
  const auto predicted = [&](std::uint64_t first_that_fails) {
    CheckEngine engine = made_up();
    engine.run = [run = engine.run, first_that_fails](const Test& one, const RunOptions& options) {
      Outcome outcome = run(one, options);
      if (specimen_of(one).packing_seed >= first_that_fails) {
        Failure failure;
        failure.reason = FailureReason::never_settled;
        outcome.failure = failure;
      }
      return outcome;
    };
    return predict(card.value(), materials, test, {}, 4, 1, engine);
  };
  const auto all = predicted(80'005), some = predicted(80'004), none = predicted(80'001);
  REQUIRE(all.ok());
  REQUIRE(some.ok());
  CHECK(all.value().failed == 0);
  CHECK(some.value().failed == 2);
  CHECK(some.value().readings.at(0).heaps == 3);
  REQUIRE_FALSE(none.ok());
  CHECK_THAT(none.faults().at(0).what, Catch::Contains("never_settled"));
}
