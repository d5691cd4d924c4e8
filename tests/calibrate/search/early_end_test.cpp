#include <catch2/catch.hpp>
#include <cmath>

#include "calibrate/evaluate/record.h"
#include "calibrate/evaluate/response.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/inference/training_data.h"
#include "calibrate/search/search.h"
#include "calibrate/search/surrogate.h"
#include "tests/calibrate/search/fake_slump.h"
#include "tests/calibrate/search/laboratory.h"

using namespace pastefit;
using namespace pastefit::test;

namespace {

/// The two-step slump test of the fake slumps in the engine's place: 100 mm are measured, and 80 mm after the drop. The
/// level is 40 mm. A heap is certain to be lost 10 mm below the cutoff only, as with a real ruler.
struct TwoSteps : Laboratory {
  bool heeds_cutoff = true;
  std::atomic<int> ended = 0;

  TwoSteps() {
    // Upside down: no formula says which strengths are likely, and a screening goes through all.
    std::get<SlumpTest>(study.tests[0].lab.test).mould = {0.065, 0.1, 0.2};
    study.tests[0].lab.measurements = {
        {"step1.height_mm", 100, 4, 3}, {"step1.spread_mm", 400, 10, 1}, {"step2.height_mm", 80, 4, 3}};
    study.tests[0].targets = {{"step1.height_mm", 1}, {"step1.spread_mm", 0}, {"step2.height_mm", 1}};
    study.search.budget_simulations = 60;
    study.search.packings = 2;
    study.search.screening = 12;
    twist = [this](const SlumpTest& test, const RunOptions& run, Outcome& outcome) {
      const double strength =
          std::log(test.contact.bridge.c_n / std::pow(test.grains.radius_m, 2) / 100) / std::log(100);
      const double noise = 3 * synthetic::normal(test.packing_seed, static_cast<std::uint64_t>(1e6 * strength));
      const double height = 20 + 250 * strength + 10 * test.contact.friction + noise;
      outcome.readings = {};
      outcome.readings.set("fill.mass_kg", 9);
      const double lowest = run.cutoff ? run.cutoff->lowest : 0;
      const double highest = run.cutoff ? run.cutoff->highest : 1e9;
      outcome.run.ended_early = heeds_cutoff && height < lowest - 10;
      if (!outcome.run.ended_early) {
        outcome.readings.set("step1.height_mm", height);
        outcome.readings.set("step1.spread_mm", 600 - height);
        outcome.run.ended_early = heeds_cutoff && (height < lowest || height > highest);
      }
      if (outcome.run.ended_early) {
        ++ended;
        return;
      }
      outcome.readings.set("step2.height_mm", 0.85 * height - 20 * (test.contact.friction - 0.5));
    };
  }
};

/// Points from the weakest to the strongest.
std::vector<UnitPoint> ladder() {
  std::vector<UnitPoint> points;
  for (int k = 0; k <= 20; ++k) points.push_back(at(0.05 * k, 0.5));
  return points;
}

/// The same numbers, missing ones included.
bool same(const Response& a, const Response& b) {
  if (a.censored != b.censored || a.misfit != b.misfit || a.residuals != b.residuals) return false;
  for (Eigen::Index k = 0; k < a.readings.size(); ++k)
    if (a.readings[k] != b.readings[k] && !(std::isnan(a.readings[k]) && std::isnan(b.readings[k]))) return false;
  return true;
}

}  // namespace

TEST_CASE("the cutoff lies about the laboratory's height, as wide as tolerance and deviation ask") {
  TwoSteps laboratory;
  Study& study = laboratory.study;
  auto cutoff = cutoff_of(study, 0);
  REQUIRE(cutoff);
  CHECK(cutoff->lowest == Approx(60));
  CHECK(cutoff->highest == Approx(140));
  study.tests[0].lab.measurements[0].standard_deviation = 15;
  CHECK(cutoff_of(study, 0)->lowest == Approx(40));
  study.tests[0].targets[2].weight = 0;  // step 2 is not fitted
  CHECK(std::isinf(cutoff_of(study, 0)->highest));
  study.tests[0].targets[0].weight = 0;
  CHECK_FALSE(cutoff_of(study, 0));
  study.tests[0].targets[0].weight = 1;
  study.search.end_early = false;
  CHECK_FALSE(cutoff_of(study, 0));
}

TEST_CASE("a simulation that was ended and one that was not answer the same") {
  TwoSteps cut, whole;
  whole.heeds_cutoff = false;
  auto store_cut = cut.store(), store_whole = whole.store();
  SimulationObjective ended(cut.study, store_cut, cut.options), run_through(whole.study, store_whole, whole.options);
  int below = 0, within = 0, above = 0;
  for (const UnitPoint& point : ladder()) {
    const Response a = ended.try_out({&point, 1}, kPackings).at(0),
                   b = run_through.try_out({&point, 1}, kPackings).at(0);
    CHECK(same(a, b));
    const Response full = run_through.evaluate({&point, 1}, kPackings).at(0);
    CHECK_FALSE(full.censored);
    CHECK(a.misfit <= full.misfit);
    if (full.readings[0] < 55) {
      ++below;
      CHECK(a.readings[0] == Approx(60));
      CHECK(std::isnan(a.readings[2]));
    } else if (full.readings[0] > 145) {
      ++above;
      CHECK(a.readings[0] == full.readings[0]);
      CHECK(std::isnan(a.readings[2]));
    } else if (full.readings[0] > 65 && full.readings[0] < 135) {
      ++within;
      CHECK(same(a, full));
    }
  }
  CHECK(below > 2);
  CHECK(within > 2);
  CHECK(above > 2);
  CHECK(cut.ended > 10);
}

TEST_CASE("a candidate that meets the laboratory is not ended") {
  TwoSteps laboratory;
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  const Response response = objective.try_out(std::vector<UnitPoint>{at(0.30, 0.5)}, kPackings).at(0);
  CHECK(response.readings[0] == Approx(100).margin(6));
  CHECK_FALSE(response.censored);
  CHECK(laboratory.ended == 0);
}

TEST_CASE("an evaluation that ended early never stands in for a whole one, and a whole one serves both") {
  TwoSteps laboratory;
  auto store = laboratory.store();
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  const std::vector<UnitPoint> low{at(0.05, 0.5)}, lower{at(0.02, 0.5)};
  CHECK(objective.try_out(low, kPackings).at(0).censored);
  CHECK(laboratory.runs == 2);
  CHECK(objective.counts().best_error < 0);
  const Response whole = objective.evaluate(low, kPackings).at(0);
  CHECK(laboratory.runs == 4);
  CHECK_FALSE(whole.censored);
  CHECK(whole.readings.allFinite());
  CHECK(store.size() == 4);

  (void)objective.evaluate(lower, kPackings);
  CHECK(objective.try_out(lower, kPackings).at(0).censored);
  CHECK(laboratory.runs == 6);
}

TEST_CASE("an answer that ended early is never better than one that has all its readings") {
  Response ended, whole;
  ended.point = whole.point = at(0.5, 0.5);
  ended.residuals = Eigen::Vector2d(1, 0);
  whole.residuals = Eigen::Vector2d(9, 9);
  ended.misfit = 0.5;
  whole.misfit = 81;
  CHECK(is_better(ended, whole));
  ended.censored = true;
  CHECK_FALSE(is_better(ended, whole));
  CHECK(is_better(whole, ended));
}

TEST_CASE("the surrogate learns a reading from the simulations that took it") {
  std::vector<Response> seen;
  for (int k = 0; k <= 10; ++k) {
    Response one;
    one.point = at(0.1 * k, 0.5);
    one.packings = {1};
    one.censored = k < 5;
    one.readings = Eigen::Vector2d(k, k < 5 ? std::nan("") : 5.0);
    one.residuals = Eigen::Vector2d(k - 5, k < 5 ? 0.0 : 3.0);
    one.misfit = 0.5 * one.residuals.squaredNorm();
    seen.push_back(one);
  }
  Surrogate surrogate(seen);
  const std::vector<UnitPoint> points{at(0.1, 0.5), at(0.8, 0.5)};
  for (const UnitPoint& point : points) CHECK(surrogate.expected_residuals(point)[1] == Approx(3));
  for (Response& one : seen) {
    one.censored = true;
    one.readings[1] = std::nan("");
  }
  CHECK(Surrogate(seen).expected_residuals(points.at(1))[1] == 0);
}

TEST_CASE("what any search left in a store is found again, run to its end where it was, by whichever program") {
  TwoSteps laboratory;
  {
    auto store = laboratory.store();
    SimulationObjective objective(laboratory.study, store, laboratory.options);
    const std::vector<UnitPoint> points{at(0.1, 0.5), at(0.8, 0.5)};
    (void)objective.try_out(points, kPackings);
    (void)objective.evaluate({&points[1], 1}, kPackings);
  }
  const auto store = Store::read(laboratory.folder.path() / "evaluations.sqlite");
  REQUIRE(store.ok());
  CHECK(store.value().identity().program == "program");
  const auto record = everything_of(laboratory.study, store.value());
  REQUIRE(record.size() == 4);
  for (std::size_t i = 0; i < record.size(); ++i) CHECK(record[i].run.ended_early == (record[i].point[0] < 0.5));
  laboratory.study.parameters.front().value *= 2;  // and is another material now
  laboratory.study.parameters.front().free = false;
  CHECK(everything_of(laboratory.study, store.value()).empty());
  CHECK_FALSE(Store::read(laboratory.folder.path() / "none.sqlite").ok());
}

TEST_CASE("a search that ends candidates early, killed and resumed, brings the same, and its inference too") {
  const auto calibrate = [](TwoSteps& laboratory) {
    auto store = laboratory.store();
    SimulationObjective objective(laboratory.study, store, laboratory.options);
    Calibration calibration = search(objective, laboratory.study.search);
    const TrainingData evidence =
        training_data_of(laboratory.study, record_of(laboratory.study, store, calibration.history));
    return std::pair{std::move(calibration), evidence};
  };
  TwoSteps undisturbed;
  undisturbed.options.threads = 1;
  const auto [first, evidence] = calibrate(undisturbed);
  CHECK(first.status == CalibrationStatus::confirmed);
  CHECK(undisturbed.ended > 4);
  CHECK_FALSE(first.best.censored);
  CHECK_FALSE(first.confirmation.censored);
  for (const ReadingTrainingData& reading : evidence.readings) {
    if (reading.name == "step2.height_mm") CHECK(reading.simulated.array().isNaN().any());
    if (reading.name != "step1.height_mm") continue;
    const double lowest = cutoff_of(undisturbed.study, 0)->lowest;
    for (std::size_t i = 0; i < evidence.points.size(); ++i)
      CHECK(reading.bound(i) == (reading.simulated[static_cast<Eigen::Index>(i)] == lowest));
    CHECK(std::ranges::find(reading.is_bound, true) != reading.is_bound.end());
  }

  for (const int killed_after : {3, 9, 17}) {
    TwoSteps killed;
    killed.options.threads = 1;
    std::atomic<bool> stop = false;
    killed.options.stop = &stop;
    const auto honest = killed.twist;
    killed.twist = [&](const SlumpTest& test, const RunOptions& run, Outcome& outcome) {
      honest(test, run, outcome);
      if (killed.runs == killed_after) stop = true;
    };
    (void)calibrate(killed);
    stop = false;
    const auto [second, its_evidence] = calibrate(killed);
    CHECK(second.reason == first.reason);
    CHECK(same(second.best, first.best));
    CHECK(second.simulations == first.simulations);
    REQUIRE(its_evidence.points.size() == evidence.points.size());
    CHECK(its_evidence.points == evidence.points);
    // The one that the stop hit runs again.
    CHECK(killed.runs <= undisturbed.runs + 1);
  }
}
