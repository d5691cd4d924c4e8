#include "calibrate/search/comparison.h"

#include <catch2/catch.hpp>

#include "calibrate/report/misfit_figure.h"
#include "fake_slump.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

ComparisonOptions options_for(std::vector<std::string> strategies) {
  ComparisonOptions options;
  options.strategies = std::move(strategies);
  options.seeds = 3;
  for (std::uint64_t packing = 9001; packing <= 9008; ++packing) options.judge_packings.push_back(packing);
  return options;
}

std::unique_ptr<Objective> fake(int budget) {
  auto objective = std::make_unique<Synthetic>(fake_slump(150, 4));
  objective->budget = budget;
  return objective;
}

}  // namespace

TEST_CASE("strategies are compared with the same budget and judged on the same packings") {
  std::vector<std::string> finished;
  const auto trials = compare_strategies(fake, options_for({"default", "bobyqa", "dogleg"}),
                                         [&](const StrategyTrial& trial) { finished.push_back(trial.strategy); });
  REQUIRE(trials.size() == 9);
  CHECK(finished.size() == 9);
  for (const StrategyTrial& trial : trials) {
    CAPTURE(trial.strategy, trial.seed);
    CHECK(trial.simulations <= 60);
    CHECK(trial.errors.size() == static_cast<std::size_t>(trial.simulations));
    CHECK(trial.judged >= 0);
    CHECK(trial.judged < 10);  // two tolerances
  }
  CHECK(trials[0].errors[7] == trials[1].errors[7]);  // the screening is the same
}

TEST_CASE("a comparison is repeated exactly") {
  const auto once = compare_strategies(fake, options_for({"default"}));
  const auto again = compare_strategies(fake, options_for({"default"}));
  for (std::size_t i = 0; i < once.size(); ++i) {
    CHECK(once[i].errors == again[i].errors);
    CHECK(once[i].judged == again[i].judged);
  }
}

TEST_CASE("a stop ends a comparison without the trial it cuts off") {
  int made = 0;
  const auto objective = [&](int budget) -> std::unique_ptr<Objective> {
    auto one = std::make_unique<Synthetic>(fake_slump(150, 4));
    one->budget = budget;
    if (++made == 3) one->stop = [] { return true; };
    return one;
  };
  CHECK(compare_strategies(objective, options_for({"default", "bobyqa"})).size() == 1);
}

TEST_CASE("rows are ordered by what was confirmed, then by what it cost, and drawn") {
  StrategyTrial good{"good", 1, CalibrationStatus::confirmed, 30, 0, {9, 9, 2}, 1.5};
  StrategyTrial cheap{"cheap", 1, CalibrationStatus::confirmed, 20, 0, {8, 3}, 2.5};
  StrategyTrial bad{"bad", 1, CalibrationStatus::unconfirmed, 10, 10, {}, -1};
  const auto rows = summary_of(std::vector<StrategyTrial>{bad, good, cheap});
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].strategy == "cheap");
  CHECK(rows[1].strategy == "good");
  CHECK(rows[2].judged == -1);
  const std::string figure = misfit_figure(rows, ErrorUnit{5.0}, "title");
  CHECK(figure.find("<svg") == 0);
  CHECK(figure.find("cheap") != std::string::npos);
  CHECK(figure.find("nan") == std::string::npos);
}

TEST_CASE("no strategy hangs, loses its best or confirms what fails, whatever fails", "[campaign]") {
  for (const std::string_view name : strategy_names()) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(name, seed);
      Synthetic objective = fake_slump(40 + 250 * uniform(seed, 77), seed);
      objective.fails = failing_region(seed, 5);
      objective.failure_kind = static_cast<FailureKind>(seed % 4);
      SearchOptions options;
      options.seed = seed;
      options.strategy = name;
      const Calibration calibration = search(objective, options);
      CHECK(objective.simulations <= 60);
      CHECK(calibration.simulations == objective.simulations);
      if (calibration.best.point.size() == 0) continue;
      CHECK(is_feasible(calibration.best));
      if (calibration.status == CalibrationStatus::confirmed) CHECK(calibration.confirmation.error <= 1);
    }
  }
}
