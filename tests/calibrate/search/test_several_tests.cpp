#include <catch2/catch.hpp>

#include "calibrate/card/calibration_card.h"
#include "calibrate/evaluate/record.h"
#include "tests/calibrate/search/laboratory.h"

using namespace pastefit;
using namespace pastefit::test;

namespace {

/// A second test of the same material, whose mould is of other size: it reads 200 mm lower.
void add_low_mould(Laboratory& laboratory, bool hold_out) {
  auto& tests = laboratory.study.tests;
  tests[0].name = "high";
  tests.push_back(tests[0]);
  tests[1].name = "low";
  tests[1].hold_out = hold_out;
  std::get<SlumpTest>(tests[1].lab.test).mould.height_m = 0.06;
  tests[1].lab.measurements = {{"step1.height_mm", 20, 1, 2}};
  tests[1].targets = {{"step1.height_mm", 1}};
  laboratory.twist = [](const SlumpTest& test, const RunOptions&, Outcome& outcome) {
    if (test.mould.height_m != 0.06) return;
    outcome.readings.set("step1.height_mm", 20 + static_cast<double>(test.packing_seed));
  };
}

}  // namespace

TEST_CASE("two tests of one material are one residual vector, each reading under its test's name") {
  Laboratory laboratory;
  add_low_mould(laboratory, false);
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  CHECK(objective.residuals() == 4);
  CHECK(objective.simulations_each() == 2);
  CHECK(objective.budget_left() == 10);
  const std::vector<UnitPoint> points{at(0.5, 0.5)};
  const auto response = objective.evaluate(points, kPackings)[0];
  CHECK(response.readings[0] == Approx(102));
  CHECK(response.readings[3] == Approx(22));
  CHECK(response.residuals[3] == Approx(2));
  CHECK(response.error == Approx(1));
  CHECK(laboratory.runs == 4);
  CHECK(laboratory.fills == 4);
  CHECK(objective.counts().simulated == 4);
  CHECK(objective.budget_left() == 8);
  const auto record = record_of(laboratory.study, store, std::vector<Response>{response});
  REQUIRE(record.size() == 2);
  CHECK(record[0].readings.find("high/step1.height_mm") == 101.0);
  CHECK(record[0].readings.find("low/step1.height_mm") == 21.0);
}

TEST_CASE("a candidate that fails in one of two tests has failed") {
  Laboratory laboratory;
  add_low_mould(laboratory, false);
  laboratory.twist = [](const SlumpTest& test, const RunOptions&, Outcome& outcome) {
    if (test.mould.height_m == 0.06) fail(outcome, FailureReason::grain_lost, 0.1);
  };
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  const auto response = objective.evaluate(std::vector<UnitPoint>{at(0.5, 0.5)}, kPackings)[0];
  CHECK(response.failed);
  CHECK(response.evaluations[0].failure->reason == FailureReason::grain_lost);
  CHECK(objective.counts().failures[FailureReason::grain_lost] == 2);
}

TEST_CASE("a test that is held out is never simulated by a search, and predicted when asked") {
  Laboratory laboratory;
  add_low_mould(laboratory, true);
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  CHECK(objective.residuals() == 3);
  (void)objective.evaluate(std::vector<UnitPoint>{at(0.5, 0.5)}, kPackings);
  CHECK(laboratory.runs == 2);
  const auto predicted = objective.predict(at(0.5, 0.5), kPackings, 1);
  REQUIRE(predicted.size() == 2);
  CHECK(predicted[1].readings.find("step1.height_mm") == 23.0);
  CHECK(objective.budget_left() == 16);
}

TEST_CASE("a hold-out is judged by the noise of both sides, and only what counts is judged") {
  for (const auto& [measured, within] : {std::pair{23.0, true}, std::pair{40.0, false}}) {
    Laboratory laboratory;
    add_low_mould(laboratory, true);
    auto& held = laboratory.study.tests[1];
    held.lab.measurements = {{"step1.height_mm", measured, 1, 2}, {"step1.spread_mm", 900, 1, 2}};
    held.targets = {{"step1.height_mm", 1}, {"step1.spread_mm", 0}};
    auto store = laboratory.store();
    SimulationObjective objective(laboratory.study, store, laboratory.options);
    Calibration calibration;
    const std::vector<UnitPoint> points{at(0.5, 0.5)};
    calibration.best = calibration.search = calibration.confirmation =
        objective.evaluate(points, std::vector<std::uint64_t>{1, 2, 3, 4})[0];
    const auto card = [&] { return card_of(laboratory.study, calibration, store, objective.counts(), "study.json"); };
    REQUIRE(card().tests.size() == 2);
    CHECK(card().tests[1].readings.empty());  // not predicted yet
    CHECK_FALSE(card().tests[1].within_noise);
    (void)objective.predict(points[0], calibration.confirmation.packings, 1);
    const CardTest test = card().tests[1];
    CHECK(test.name == "low");
    REQUIRE(test.within_noise);
    CHECK(*test.within_noise == within);
    CHECK(test.readings[0].simulated.mean == Approx(22.5));
    CHECK(test.readings[0].band);
    CHECK_FALSE(test.readings[1].band);
    CHECK(card().tests[0].readings[0].measured == 100.0);
    CHECK(card().tests[0].baseline.runs.size() == 4);
  }
}

TEST_CASE("what was simulated before holds within narrower bounds, and for another reading of the laboratory") {
  Laboratory laboratory;
  const auto stored = [&](const char* inputs) {
    auto opened = Store::open(laboratory.folder.path() / "evaluations.sqlite", {"program", inputs});
    REQUIRE(opened.ok());
    return std::move(opened).value();
  };
  {
    auto store = stored("{}");
    SimulationObjective objective(laboratory.study, store, laboratory.options);
    CHECK(objective.earlier().empty());
    (void)objective.evaluate(std::vector<UnitPoint>{at(0.25, 0.5), at(0.75, 0.5), at(0.5, 0.1)}, kPackings);
    CHECK(objective.earlier().empty());  // its own search asks for them again
  }
  laboratory.study.parameters[0].lower = 1000;  // the middle of 100 to 10000 on its scale
  laboratory.study.tests[0].lab.measurements[0].value = 90;
  {
    auto store = stored(R"({"narrower": true})");
    SimulationObjective objective(laboratory.study, store, laboratory.options);
    const auto earlier = objective.earlier();
    REQUIRE(earlier.size() == 4);  // 0.75 and 0.5 of the old range, two packings each
    CHECK(earlier[0].point[0] == Approx(0).margin(1e-9));
    CHECK(earlier[0].point[1] == Approx(0.1));
    CHECK(earlier[2].point[0] == Approx(0.5));
    CHECK(earlier[2].packings == std::vector<std::uint64_t>{1});
    CHECK(earlier[2].residuals[0] == Approx(2 * (101 - 90) / 2.0));
    CHECK(record_of(laboratory.study, store, {}).size() == 4);
    (void)objective.evaluate(std::vector<UnitPoint>{at(0.3, 0.5)}, kPackings);
    CHECK(objective.earlier().size() == 4);
  }
  std::get<SlumpTest>(laboratory.study.tests[0].lab.test).lift_velocity_m_s *= 2;  // another test: nothing holds
  auto store = stored(R"({"faster": true})");
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  CHECK(objective.earlier().empty());
}
