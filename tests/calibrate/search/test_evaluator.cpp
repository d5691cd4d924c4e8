#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <set>
#include <thread>

#include "calibrate/base/machine.h"
#include "tests/calibrate/search/laboratory.h"

using namespace pastefit;
using namespace pastefit::test;

TEST_CASE("a candidate answers with the mean over its packings against the laboratory") {
  Laboratory laboratory;
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  CHECK(objective.parameters() == 2);
  CHECK(objective.residuals() == 3);
  const std::vector<UnitPoint> points{at(0.5, 0.5), at(0.5, 0.7)};
  const auto responses = objective.evaluate(points, kPackings);
  REQUIRE(responses.size() == 2);
  CHECK(responses[0].readings[0] == Approx(102));
  CHECK(responses[1].readings[0] == Approx(112));
  CHECK(responses[1].residuals[0] == Approx(std::sqrt(4.0) * 12 / 2));
  CHECK(responses[1].residuals[1] == 0);
  CHECK(responses[1].residuals[2] == Approx(1));
  CHECK(responses[1].misfit == Approx(0.5 * (144 + 1)));
  CHECK(responses[1].error == Approx(12.0 / 5));
  CHECK_FALSE(responses[1].failed);
  CHECK(responses[1].evaluations[1].packing == 3);
  CHECK(responses[1].evaluations[1].readings[0] == Approx(113));
  CHECK(objective.counts().simulated == 4);
  CHECK(objective.counts().best_error == Approx(1));
  CHECK(objective.budget_left() == 16);
}

TEST_CASE("a reading is the mean over the heaps that a laboratory would not reject, or over all if it would each") {
  const UnitPoint point = at(0.5, 0.5);
  const auto answer = [&](const std::set<std::uint64_t>& sheared) {
    Laboratory laboratory;
    laboratory.twist = [&](const SlumpTest& test, const RunOptions&, Outcome& outcome) {
      outcome.readings.set("step1.lateral_shift_mm", sheared.contains(test.packing_seed) ? 500 : 0);
    };
    auto store = laboratory.store();
    SimulationObjective objective(laboratory.study, store, laboratory.options);
    return objective.evaluate({&point, 1}, std::vector<std::uint64_t>{1, 2, 6}).at(0);
  };
  const Response one = answer({6});
  CHECK(one.rejected == 1);
  CHECK(one.readings[0] == Approx(101.5));
  CHECK(one.error == Approx(1));  // of the mass
  CHECK(one.noise == Approx(0.5 / 5));
  const Response all = answer({1, 2, 6});
  CHECK(all.rejected == 3);
  CHECK(all.readings[0] == Approx(103));
}

TEST_CASE("the mould is filled once for each packing and way to fill it, however many candidates and threads ask") {
  Laboratory laboratory;
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  std::vector<UnitPoint> points;
  for (int i = 0; i < 8; ++i) points.push_back(at(0.1 * i, 0.5));
  (void)objective.evaluate(points, kPackings);
  std::set<std::string> ways;
  for (const UnitPoint& point : points)
    ways.insert(preparation_key(
        test_with(laboratory.study.tests[0].lab.test, values_at(laboratory.study, coordinates(point)), 1)));
  CHECK(laboratory.runs == 16);
  CHECK(laboratory.fills == 2 * static_cast<int>(ways.size()));
  CHECK(ways.size() < points.size());
}

TEST_CASE("grains that their own attraction would press through each other fail without being poured") {
  Laboratory laboratory;
  for (auto& parameter : laboratory.study.parameters) {
    if (parameter.name == "strength_pa") parameter.upper = 1e7;
    if (parameter.name == "youngs_modulus_pa") parameter.value = 1e5;
  }
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  const auto responses = objective.evaluate(std::vector<UnitPoint>{at(1, 0.5), at(0, 0.5)}, kPackings);
  CHECK(responses[0].failed);
  CHECK(responses[0].evaluations[0].failure->reason == FailureReason::excessive_overlap);
  CHECK(responses[0].evaluations[0].failure->value > 1);
  CHECK_FALSE(responses[1].failed);
  CHECK(laboratory.fills == 2);
  CHECK(laboratory.runs == 2);
  CHECK(store.size() == 4);
}

TEST_CASE("a candidate that is tried out keeps no energy balance, one that is evaluated does") {
  Laboratory laboratory;
  auto store = laboratory.store();
  std::atomic<int> kept = 0;
  laboratory.twist = [&](const SlumpTest&, const RunOptions& run, Outcome&) { kept += run.steps.energy_balance; };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  (void)objective.try_out(std::vector<UnitPoint>{at(0.5, 0.5)}, kPackings);
  CHECK(laboratory.runs == 2);
  CHECK(kept == 0);
  (void)objective.evaluate(std::vector<UnitPoint>{at(0.2, 0.5)}, kPackings);
  CHECK(laboratory.runs == 4);
  CHECK(kept == 2);
}

TEST_CASE("simulations that fill their own moulds share none, and run as they are asked to") {
  Laboratory laboratory;
  auto store = laboratory.store();
  laboratory.options.run.own_fill = true;
  laboratory.options.run.fixed_wait_s = 0.25;
  std::atomic<int> as_asked = 0;
  laboratory.twist = [&](const SlumpTest&, const RunOptions& run, Outcome&) {
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
  laboratory.twist = [](const SlumpTest& test, const RunOptions&, Outcome& outcome) {
    const double friction = test.contact.friction;
    if (friction < 0.05)
      fail(outcome, FailureReason::excessive_overlap, 0.1);
    else if (friction < 0.15)
      fail(outcome, FailureReason::never_settled, 5);
    else if (friction < 0.25 && test.packing_seed == 1)
      fail(outcome, FailureReason::grain_lost, 0.1);
    else if (friction > 0.95)
      outcome.readings.set("step1.height_mm", 300);  // the worst a heap can do
  };
  std::get<SlumpTest>(laboratory.study.tests[0].lab.test).mould.height_m = 0.3;
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  const std::vector<UnitPoint> points{at(0.5, 0), at(0.5, 0.1), at(0.5, 0.2), at(0.5, 1)};
  const auto responses = objective.evaluate(points, kPackings);
  for (int i = 0; i < 3; ++i) {
    CHECK(responses[i].failed);
    CHECK(std::isfinite(responses[i].misfit));
    CHECK(std::isfinite(responses[i].error));
    CHECK(responses[i].residuals.allFinite());
    CHECK(responses[i].readings.allFinite());
    CHECK(responses[i].misfit > 2 * responses[3].misfit);
  }
  CHECK(responses[0].misfit > responses[1].misfit);
  CHECK(responses[0].misfit > responses[2].misfit);
  CHECK(objective.counts().failures[FailureReason::excessive_overlap] == 2);
  CHECK(objective.counts().failures[FailureReason::never_settled] == 2);
  CHECK(objective.counts().failures[FailureReason::grain_lost] == 1);
  CHECK(objective.counts().best_error == Approx(200.0 / 5));
  CHECK(store.size() == 8);
}

TEST_CASE("a reading that is missing or not a number is a classified failure") {
  Laboratory laboratory;
  auto store = laboratory.store();
  laboratory.twist = [](const SlumpTest& test, const RunOptions&, Outcome& outcome) {
    if (test.packing_seed == 1) outcome.readings.set("fill.mass_kg", std::numeric_limits<double>::quiet_NaN());
    if (test.packing_seed == 3) outcome.readings = {};
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
  std::atomic<bool> stop = false, in_time = true;
  laboratory.options.stop = &stop;
  laboratory.options.threads = 2;
  laboratory.twist = [&](const SlumpTest&, const RunOptions& run, Outcome& outcome) {
    if (laboratory.runs > 2) stop = true;
    if (laboratory.runs <= 2) return;
    if (!comes_true([&] { return !run.watch({}); })) in_time = false;
    fail(outcome, FailureReason::stopped, 0.1);
  };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  (void)objective.evaluate(std::vector<UnitPoint>{at(0.5, 0.5)}, kPackings);
  const std::vector<UnitPoint> points{at(0.1, 0.5), at(0.2, 0.5), at(0.3, 0.5), at(0.4, 0.5)};
  const auto responses = objective.evaluate(points, kPackings);
  CHECK(in_time);
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
  laboratory.twist = [&](const SlumpTest& test, const RunOptions& run, Outcome& outcome) {
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

TEST_CASE("core-seconds are counted over all simulations, and spent they are a stop request") {
  Laboratory laboratory;
  auto store = laboratory.store();
  laboratory.options.core_budget_s = 0.05;
  laboratory.twist = [](auto&&...) {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));  // a core that waits is not counted
    for (const double start = thread_seconds(); thread_seconds() - start < 0.02;) continue;
  };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  (void)objective.evaluate(std::vector<UnitPoint>{at(0.5, 0.5)}, std::vector<std::uint64_t>{1});
  CHECK_FALSE(objective.stop_requested());
  (void)objective.evaluate(std::vector<UnitPoint>{at(0.1, 0.5), at(0.2, 0.5)}, kPackings);
  CHECK(objective.stop_requested());
}

TEST_CASE("what is known of a parameter beforehand is a residual of its own, in its own deviations") {
  Laboratory laboratory;
  auto& strength = laboratory.study.parameters[0];
  strength.prior = Prior{1000, 230.2585092994046};  // a hundredth of two decades: 0.05 of ln(10000/100)
  laboratory.study.parameters[5].prior = Prior{0.4, 0.1};
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  CHECK(objective.residuals() == 5);
  CHECK(objective.readings() == 3);
  const auto response = objective.evaluate(std::vector<UnitPoint>{at(0.6, 0.5)}, kPackings)[0];
  CHECK(response.readings.size() == 3);
  CHECK(response.residuals[3] == Approx(2));
  CHECK(response.residuals[4] == Approx(1));
  CHECK(response.error == Approx(1));
  CHECK(response.misfit == Approx(0.5 * response.residuals.squaredNorm()));
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
