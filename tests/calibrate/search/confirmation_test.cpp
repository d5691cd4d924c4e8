#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <set>

#include "answered.h"
#include "calibrate/search/confirmation_phase.h"
#include "calibrate/search/search.h"
#include "fake_slump.h"
#include "laboratory.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

/// The fake slump with so much noise in one simulation.
Synthetic noisy_slump(double height_mm, double noise_mm, std::uint64_t seed) {
  Synthetic objective = fake_slump(height_mm, seed);
  const auto calm = objective.observe;
  objective.observe = [calm, noise_mm](const UnitPoint& x, std::uint64_t packing) {
    const double mean = mean_height(x);
    return std::vector<double>{std::clamp(mean + noise_mm / 4 * (calm(x, packing)[0] - mean), 0.0, 300.0)};
  };
  return objective;
}

SearchOptions generous_options(std::uint64_t seed) {
  SearchOptions options = options_with(seed);
  options.budget_simulations = 200;
  options.confirmation_packings = 8;
  return options;
}

/// A confirmation phase of a search that knows one candidate, tried on one packing.
struct Judged {
  Judged(Synthetic& objective, const UnitPoint& candidate)
      : answered(objective), state(answered.queue, options, {}, unheard), phase(state) {
    state.history.evaluate({&candidate, 1}, {&state.common[0], 1});
    answered.answers_of(state.history);
  }
  bool confirm(bool whatever_it_does = true) {
    phase.begin(whatever_it_does);
    answered.run(phase, state.history);
    return phase.confirmed();
  }
  void finish() {
    phase.begin_last();
    answered.run(phase, state.history);
  }

  const SearchOptions options = generous_options(1);
  const std::function<void(const Progress&)> unheard;
  Answered answered;
  StrategyState state;
  ConfirmationPhase phase;
};

}  // namespace

TEST_CASE("the noise of a mean is the scatter of its packings over the root of their number") {
  Synthetic objective;
  objective.measured = {100, 50};
  objective.standard_deviations = {5, 5};
  objective.observe = [](const UnitPoint&, std::uint64_t packing) {
    return std::vector<double>{100 + 3.0 * (packing % 2 == 0 ? 1 : -1), 60};
  };
  const std::vector<std::uint64_t> four{1, 2, 3, 4}, one{1};
  const UnitPoint point = UnitPoint::Constant(2, 0.5);
  // Standard errors sqrt(4 * 9/(4 * 3)) and 0: the larger one.
  CHECK(objective.evaluate({&point, 1}, four).at(0).noise == Approx(std::sqrt(3.0) / 5));
  CHECK(objective.evaluate({&point, 1}, one).at(0).noise == 0);
}

TEST_CASE("where packings scatter, more of them are asked until luck cannot confirm a candidate", "[campaign]") {
  int confirmed = 0, widened = 0, near = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    const double height = 80 + 160 * uniform(seed, 77);
    Synthetic objective = noisy_slump(height, 20, seed);
    const Calibration calibration = search(objective, generous_options(seed));
    CHECK(calibration.simulations <= 200);
    const auto fresh = std::ssize(calibration.confirmation.packings);
    CHECK((fresh >= 8 && fresh <= 64 && fresh % 4 == 0));
    CHECK(std::set(calibration.confirmation.packings.begin(), calibration.confirmation.packings.end()).size() ==
          calibration.confirmation.packings.size());
    if (calibration.status != CalibrationStatus::confirmed) {
      CHECK(calibration.status == CalibrationStatus::unconfirmed);
      continue;
    }
    ++confirmed;
    widened += fresh > 8;
    near += std::abs(mean_height(calibration.best.point) - height) <= 10;
    CHECK(calibration.confirmation.noise <= 1);
  }
  INFO(confirmed << " of 40 confirmed, " << near << " of them within 10 mm, " << widened << " on more than 8 packings");
  CHECK(confirmed >= 28);
  CHECK(widened >= 10);
  CHECK(near >= confirmed - 2);  // a mean is within two of its errors of the truth, 5 mm each
}

TEST_CASE("nothing is refined on packings whose luck is more than the tolerance", "[campaign]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Synthetic objective = noisy_slump(80 + 160 * uniform(seed, 77), 25, seed);
    std::vector<std::string> phases;
    search(objective, generous_options(seed), [&](const Progress& progress) { phases.emplace_back(progress.phase); });
    const auto refinement = std::ranges::find(phases, "refinement"),
               confirmation = std::ranges::find(phases, "confirmation");
    REQUIRE(confirmation != phases.end());
    CHECK(confirmation < refinement);  // two packings: 18 mm
  }
}

TEST_CASE("a mean within the tolerance that may be luck is told so when the budget is spent", "[campaign]") {
  int luck = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SearchOptions options = generous_options(seed);
    options.budget_simulations = 24;
    Synthetic objective = noisy_slump(150, 60, seed);
    const Calibration calibration = search(objective, options);
    CHECK(calibration.status != CalibrationStatus::confirmed);
    const Response& told = calibration.confirmation;
    if (told.point.size() == 0 || told.error > 1 || told.noise <= 1) continue;
    ++luck;
    CHECK(calibration.reason.find("scatter too much") != std::string::npos);
    CHECK(calibration.reason.find("more than the tolerance") == std::string::npos);
  }
  CHECK(luck >= 3);
}

TEST_CASE("a fit of a mass is confirmed only if its scatter allows it, as a fit of a height is") {
  test::Laboratory laboratory;
  laboratory.study.tests[0].targets[0].weight = 0;  // the mass alone is fitted
  double scatter_kg = 4;
  laboratory.twist = [&](const SlumpTest& test, const RunOptions&, Outcome& outcome) {
    outcome.readings.set("fill.mass_kg", 9 + (test.packing_seed % 2 == 0 ? scatter_kg : -scatter_kg));
  };
  laboratory.study.search.screening = 4;
  for (const bool calm : {false, true}) {
    CAPTURE(calm);
    if (calm) scatter_kg = 0.05;  // half of the laboratory's deviation
    const test::Folder folder;
    auto opened = Store::open(folder.path() / "evaluations.sqlite", {"program", "inputs"});
    REQUIRE(opened.ok());
    SimulationObjective objective(laboratory.study, opened.value(), laboratory.options);
    const Calibration calibration = search(objective, laboratory.study.search);
    CHECK((calibration.status == CalibrationStatus::confirmed) == calm);
  }
}

TEST_CASE("packings are not asked for where their scatter says that no affordable number of them would do") {
  const UnitPoint point = UnitPoint::Constant(5, 0.5);
  Synthetic slump = fake_slump(100, 1);
  slump.budget = 200;
  // One heap stands and the next one shears off: their mean is the laboratory's.
  slump.observe = [](const UnitPoint&, std::uint64_t packing) {
    return std::vector<double>{packing % 2 == 0 ? 10.0 : 190.0};
  };
  Judged judged(slump, point);
  ConfirmationPhase& phase = judged.phase;
  CHECK_FALSE(judged.confirm());
  CHECK(phase.confirmation().packings.size() == 8);
  CHECK(packings_to_decide(evidence_of(phase.confirmation())) > 64);
}

TEST_CASE("a material is confirmed for how its heaps stand, not for their mean alone", "[campaign]") {
  const auto chance = [](const UnitPoint& x) { return 1 / (1 + std::exp(-10 * (x[3] - 0.6))); };
  int confirmed = 0, stand = 0, keep = 0, would_keep = 0;  // the last two: the share that is allowed
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double share : {0.2, 1.0}) {
      Synthetic slump = fake_slump(150, seed);
      slump.budget = 200;
      slump.rejection_index = [&, seed](const UnitPoint& x, std::uint64_t packing) {
        const double deviate = boost::math::quantile(boost::math::normal_distribution<>(), chance(x));
        return std::pow(std::max(0.0, 1 + 0.2 * (deviate + normal(hash_of(seed, digest(x)), packing))), 2);
      };
      slump.allowed_share = share;
      SearchOptions options = options_with(seed);
      options.budget_simulations = 200;
      options.confirmation_packings = 8;
      const Calibration found = search(slump, options);
      if (found.status != CalibrationStatus::confirmed) continue;
      if (share == 1) {
        would_keep += chance(found.best.point) <= 0.2 ? 1 : 0;
        continue;
      }
      ++confirmed;
      stand += chance(found.best.point) <= 0.25 ? 1 : 0;
      keep += chance(found.best.point) <= 0.2 ? 1 : 0;
    }
  }
  INFO(confirmed << " of 20 confirmed, " << stand << " stand, " << keep
                 << " keep to the share; not judged: " << would_keep);
  CHECK(confirmed >= 18);
  CHECK(stand >= 0.85 * confirmed);
  CHECK(would_keep < keep);
}

TEST_CASE("a quarter of a confirmation is asked first, and all of it at once where workers would be idle") {
  for (const int max_pending : {0, 1}) {
    CAPTURE(max_pending);
    Synthetic slump = fake_slump(150, 1);
    SearchOptions options = generous_options(1);
    options.max_pending = max_pending;
    Search search(slump, options, {.simulations = options.budget_simulations});
    std::ptrdiff_t asked_at_once = 0;
    while (!search.finished()) {
      const std::vector<Candidate> candidates = search.suggest(64);
      if (asked_at_once == 0) asked_at_once = std::ranges::count(candidates, "confirmation", &Candidate::purpose);
      for (const Candidate& one : candidates) {
        const auto answer = one.may_end_early ? &Objective::try_out : &Objective::evaluate;
        const Response response = (slump.*answer)({&one.point, 1}, {&one.packing, 1}).at(0);
        const CandidateResult result{one.number, response.evaluations.at(0)};
        search.ingest({&result, 1});
      }
    }
    CHECK(asked_at_once == (max_pending == 0 ? 2 : 8));
    CHECK(search.result().status == CalibrationStatus::confirmed);
  }
}

TEST_CASE(
    "a confirmation that was broken off for heaps that sheared is finished as far as its packings leave it open") {
  const UnitPoint point = UnitPoint::Constant(5, 0.5);
  Synthetic slump = fake_slump(mean_height(point), 1);
  slump.allowed_share = 0.2;
  slump.budget = 200;
  slump.rejection_index = [](const UnitPoint&, std::uint64_t packing) {
    return packing == 1003 || packing == 1004 ? 2.25 : 0.25;  // the first fresh ones
  };
  Judged judged(slump, point);
  ConfirmationPhase& phase = judged.phase;
  CHECK_FALSE(judged.confirm(false));
  CHECK(phase.confirmation().packings.size() == 2);
  judged.finish();
  CHECK(phase.confirmed());
  CHECK(phase.confirmation().rejected == 2);
  CHECK(phase.confirmation().packings.size() == 20);
}

TEST_CASE("a share of rejected heaps that is nearly the allowed one is not asked for on and on") {
  const UnitPoint point = UnitPoint::Constant(5, 0.5);
  Synthetic slump = fake_slump(mean_height(point), 1);
  slump.allowed_share = 0.2;
  slump.budget = 200;
  slump.rejection_index = [](const UnitPoint&, std::uint64_t packing) { return packing % 5 == 0 ? 2.25 : 0.25; };
  Judged judged(slump, point);
  ConfirmationPhase& phase = judged.phase;
  CHECK_FALSE(judged.confirm(false));
  CHECK(phase.confirmation().packings.size() == 32);
  CHECK(phase.confirmation().rejected == 6);
}
