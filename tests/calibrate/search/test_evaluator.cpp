#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <thread>

#include "calibrate/search/evaluator.h"
#include "calibrate/study/parameters.h"
#include "core/rigs/packing.h"

using namespace pastefit;

namespace {

/// A study of two free parameters and three readings, of which the spread is not fitted, with an engine that answers
/// at once: height = 100 mm + 1 mm per packing seed + 50 mm (friction - 0.5).
struct Laboratory {
  std::filesystem::path folder;
  Study study;
  std::atomic<int> fills = 0;
  std::atomic<int> runs = 0;
  std::function<void(const SlumpTable&, const RunOptions&, Outcome&)> twist = [](auto&&...) {};
  EvaluatorOptions options;

  Laboratory() {
    std::string name = (std::filesystem::temp_directory_path() / "pastefit-evaluator-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    folder = name;
    for (const auto& kind : parameter_kinds())
      study.parameters.push_back({std::string(kind.name), false, kind.usual, 0, 0, kind.scale});
    for (auto& parameter : study.parameters) {
      if (parameter.name == "strength_pa") parameter = {"strength_pa", true, 0, 100, 10000, Scale::logarithmic};
      if (parameter.name == "friction") parameter = {"friction", true, 0, 0, 1, Scale::linear};
    }
    study.lab.measurements = {
        {"step1.height_mm", 100, 2, 3}, {"step1.spread_mm", 400, 10, 1}, {"fill.mass_kg", 9, 0.1, 1}};
    study.weights = {{"step1.height_mm", 4}, {"step1.spread_mm", 0}, {"fill.mass_kg", 1}};
    study.search.budget_simulations = 20;
    options.threads = 4;
    options.simulator.fill = [this](const SlumpTable&, const RunOptions&) {
      ++fills;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      return std::make_shared<const Packing>();
    };
    options.simulator.run = [this](const SlumpTable& test, const RunOptions& run) {
      ++runs;
      Outcome outcome;
      outcome.observables.set("step1.height_mm",
                              100.0 + static_cast<double>(test.packing_seed) + 50 * (test.contact.friction - 0.5));
      outcome.observables.set("step1.spread_mm", 350);
      outcome.observables.set("fill.mass_kg", 9.1);
      outcome.run.simulated_s = 2;
      twist(test, run, outcome);
      return outcome;
    };
  }
  ~Laboratory() { std::filesystem::remove_all(folder); }

  Store store() const {
    auto opened = Store::open(folder / "evaluations.sqlite", {"study", "lab", "program"});
    REQUIRE(opened.ok());
    return std::move(opened).value();
  }
};

UnitPoint at(double strength, double friction) {
  return Eigen::Vector2d(strength, friction);
}

Outcome& fail(Outcome& outcome, FailureReason reason, double time_s) {
  outcome.observables = {};
  outcome.failure = Failure{reason, "step1.lift", 1, time_s, -1, 0, 0, "no good"};
  return outcome;
}

const std::vector<std::uint64_t> kPackings{1, 3};

}  // namespace

TEST_CASE("a candidate answers with the mean over its packings against the laboratory") {
  Laboratory laboratory;
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  CHECK(objective.parameters() == 2);
  CHECK(objective.residuals() == 3);
  const std::vector<UnitPoint> points{at(0.5, 0.5), at(0.5, 0.7)};
  const auto responses = objective.evaluate(points, kPackings);
  REQUIRE(responses.size() == 2);
  CHECK(responses[0].observables[0] == Approx(102));
  CHECK(responses[1].observables[0] == Approx(112));
  CHECK(responses[1].residuals[0] == Approx(std::sqrt(4.0) * 12 / 2));
  CHECK(responses[1].residuals[1] == 0);
  CHECK(responses[1].residuals[2] == Approx(1));
  CHECK(responses[1].misfit == Approx(0.5 * (144 + 1)));
  CHECK(responses[1].misfit_mm == Approx(12));
  CHECK_FALSE(responses[1].failed);
  CHECK(responses[1].evaluations[1].packing == 3);
  CHECK(responses[1].evaluations[1].observables[0] == Approx(113));
  CHECK(objective.counts().simulated == 4);
  CHECK(objective.counts().best_misfit_mm == Approx(2));
  CHECK(objective.budget_left() == 16);
}

TEST_CASE("the mould is filled once for each packing, however many candidates and threads ask") {
  Laboratory laboratory;
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  std::vector<UnitPoint> points;
  for (int i = 0; i < 8; ++i) points.push_back(at(0.1 * i, 0.5));
  (void)objective.evaluate(points, kPackings);
  CHECK(laboratory.runs == 16);
  CHECK(laboratory.fills == 2);
}

TEST_CASE("simulations that fill their own moulds share none, and run as they are asked to") {
  Laboratory laboratory;
  auto store = laboratory.store();
  laboratory.options.run.own_fill = true;
  laboratory.options.run.fixed_wait_s = 0.25;
  std::atomic<int> as_asked = 0;
  laboratory.twist = [&](const SlumpTable&, const RunOptions& run, Outcome&) {
    if (!run.packing && run.own_fill && run.fixed_wait_s == 0.25 && run.watch) ++as_asked;
  };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  (void)objective.evaluate(std::vector<UnitPoint>{at(0.5, 0.5), at(0.2, 0.5)}, kPackings);
  CHECK(as_asked == 4);
  CHECK(laboratory.fills == 0);
}

TEST_CASE("known evaluations are answered from the store with the same bits, and count towards the budget") {
  Laboratory laboratory;
  const std::vector<UnitPoint> points{at(0.3, 1.0 / 3), at(0.3, 1.0 / 3), at(0.9, 0.1)};
  double misfit = 0;
  {
    auto store = laboratory.store();
    SimulationObjective objective(laboratory.study, store, laboratory.options);
    const auto responses = objective.evaluate(points, kPackings);
    misfit = responses[0].misfit;
    CHECK(responses[1].misfit == misfit);
    CHECK(objective.evaluate(points, kPackings)[0].misfit == misfit);
    CHECK(objective.budget_left() == 16);
    CHECK(laboratory.runs == 4);
  }
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  CHECK(objective.evaluate(points, kPackings)[0].misfit == misfit);
  CHECK(laboratory.runs == 4);
  CHECK(objective.counts().answered == 4);
  CHECK(objective.counts().simulated == 0);
  CHECK(objective.budget_left() == 16);
}

TEST_CASE("the answers do not depend on the number of threads") {
  std::vector<UnitPoint> points;
  for (int i = 0; i < 6; ++i) points.push_back(at(0.1 * i, 1 - 0.15 * i));
  std::vector<double> misfits[2];
  for (const int threads : {1, 4}) {
    Laboratory laboratory;
    laboratory.options.threads = threads;
    auto store = laboratory.store();
    SimulationObjective objective(laboratory.study, store, laboratory.options);
    for (const auto& response : objective.evaluate(points, kPackings)) misfits[threads == 1].push_back(response.misfit);
  }
  CHECK(misfits[0] == misfits[1]);
}

TEST_CASE("a failure answers with a finite misfit beyond every candidate that ran, lower the later it failed") {
  Laboratory laboratory;
  auto store = laboratory.store();
  laboratory.twist = [](const SlumpTable& test, const RunOptions&, Outcome& outcome) {
    const double friction = test.contact.friction;
    if (friction < 0.05)
      fail(outcome, FailureReason::excessive_overlap, 0.1);
    else if (friction < 0.15)
      fail(outcome, FailureReason::never_settled, 5);
    else if (friction < 0.25 && test.packing_seed == 1)
      fail(outcome, FailureReason::grain_lost, 0.1);
    else if (friction > 0.95)
      outcome.observables.set("step1.height_mm", 300);  // the worst a heap can do
  };
  laboratory.study.lab.test.mould.height_m = 0.3;
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  const std::vector<UnitPoint> points{at(0.5, 0), at(0.5, 0.1), at(0.5, 0.2), at(0.5, 1)};
  const auto responses = objective.evaluate(points, kPackings);
  for (int i = 0; i < 3; ++i) {
    CHECK(responses[i].failed);
    CHECK(std::isfinite(responses[i].misfit));
    CHECK(std::isfinite(responses[i].misfit_mm));
    CHECK(responses[i].residuals.allFinite());
    CHECK(responses[i].observables.allFinite());
    CHECK(responses[i].misfit > 2 * responses[3].misfit);
  }
  CHECK(responses[0].misfit > responses[1].misfit);
  CHECK(responses[0].misfit > responses[2].misfit);
  CHECK(objective.counts().failures[FailureReason::excessive_overlap] == 2);
  CHECK(objective.counts().failures[FailureReason::never_settled] == 2);
  CHECK(objective.counts().failures[FailureReason::grain_lost] == 1);
  CHECK(objective.counts().best_misfit_mm == Approx(200));
  CHECK(store.size() == 8);
}

TEST_CASE("a reading that is missing or not a number is a classified failure") {
  Laboratory laboratory;
  auto store = laboratory.store();
  laboratory.twist = [](const SlumpTable& test, const RunOptions&, Outcome& outcome) {
    if (test.packing_seed == 1) outcome.observables.set("fill.mass_kg", std::numeric_limits<double>::quiet_NaN());
    if (test.packing_seed == 3) outcome.observables = {};
  };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  const std::vector<UnitPoint> points{at(0.5, 0.5)};
  const auto responses = objective.evaluate(points, kPackings);
  CHECK(responses[0].failed);
  CHECK(std::isfinite(responses[0].misfit));
  CHECK(objective.counts().failures[FailureReason::non_finite] == 2);
}

TEST_CASE("a stop request ends running simulations, which are not stored") {
  Laboratory laboratory;
  auto store = laboratory.store();
  std::atomic<bool> stop = false;
  laboratory.options.stop = &stop;
  laboratory.options.threads = 2;
  laboratory.twist = [&](const SlumpTable&, const RunOptions& run, Outcome& outcome) {
    if (laboratory.runs > 2) stop = true;
    if (laboratory.runs <= 2) return;
    while (run.watch({})) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    fail(outcome, FailureReason::stopped, 0.1);
  };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  (void)objective.evaluate(std::vector<UnitPoint>{at(0.5, 0.5)}, kPackings);
  const std::vector<UnitPoint> points{at(0.1, 0.5), at(0.2, 0.5), at(0.3, 0.5), at(0.4, 0.5)};
  const auto start = std::chrono::steady_clock::now();
  const auto responses = objective.evaluate(points, kPackings);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(2));
  CHECK(objective.stop_requested());
  CHECK(responses[3].failed);
  CHECK(responses[3].evaluations[0].failure->reason == FailureReason::stopped);
  CHECK(store.size() == 2);
  CHECK(laboratory.runs <= 4);
  CHECK(objective.counts().failures.empty());
}

TEST_CASE("a simulation beyond the wall limit is a stored failure, and the next ones run") {
  Laboratory laboratory;
  auto store = laboratory.store();
  laboratory.options.wall_limit_s = 0.02;
  laboratory.twist = [&](const SlumpTable& test, const RunOptions& run, Outcome& outcome) {
    if (test.packing_seed != 1) return;
    while (run.watch({})) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    fail(outcome, FailureReason::stopped, 0.1);
  };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  const auto responses = objective.evaluate(std::vector<UnitPoint>{at(0.5, 0.5)}, kPackings);
  CHECK(responses[0].failed);
  CHECK(responses[0].evaluations[0].failure->reason == FailureReason::stopped);
  CHECK_FALSE(responses[0].evaluations[1].failure);
  CHECK(store.size() == 2);
  CHECK_FALSE(objective.stop_requested());
}

TEST_CASE("points outside the unit cube are refused as a programming error") {
  Laboratory laboratory;
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  for (const double bad : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(objective.evaluate(std::vector<UnitPoint>{at(0.5, bad)}, kPackings), std::logic_error);
  CHECK(laboratory.runs == 0);
}

TEST_CASE("an exception of the engine reaches the caller") {
  Laboratory laboratory;
  auto store = laboratory.store();
  laboratory.twist = [](auto&&...) { throw std::runtime_error("a bug"); };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  CHECK_THROWS_WITH(objective.evaluate(std::vector<UnitPoint>{at(0.5, 0.5)}, kPackings), "a bug");
}
