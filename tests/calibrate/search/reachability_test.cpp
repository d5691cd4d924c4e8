#include "calibrate/search/reachability.h"

#include <catch2/catch.hpp>

#include "calibrate/search/search.h"
#include "tests/calibrate/search/answered.h"
#include "tests/calibrate/search/fake_slump.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

struct Screening {
  Synthetic objective;
  SearchOptions options;
  std::function<void(const Progress&)> progress;
  Answered answered;
  EvaluationHistory history;
  explicit Screening(Synthetic made, std::uint64_t seed)
      : objective(std::move(made)), answered(objective), history(answered.queue, {}, options, progress) {
    const std::uint64_t packing = 1;
    history.try_out(screening_points(5, 12, seed), {&packing, 1});
    answered.answers_of(history);
  }
  std::optional<OutOfReach> out_of_reach() {
    ReachPhase phase(history, 1, 12);
    answered.run(phase, history);
    return phase.found();
  }
};

/// As concrete mix 103: the laboratory has 10 mm, the model does no less than some 64.
Synthetic too_stiff(std::uint64_t seed) {
  Synthetic objective = fake_slump(10, seed);
  const auto before = objective.observe;
  objective.observe = [before](const UnitPoint& x, std::uint64_t packing) {
    return std::vector<double>{before(x, packing)[0] + 30};
  };
  return objective;
}

const std::vector<std::string> reading{"step1.height_mm"};
const std::vector<std::string> parameters{"strength_pa", "rupture_force_ratio", "curvature", "rupture_gap_ratio",
                                          "formation_ratio"};

}  // namespace

TEST_CASE("a height below all that the model can do is called out of reach before the search, with the bound") {
  int called = 0, named = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Screening screened(too_stiff(seed), seed);
    const auto found = screened.out_of_reach();
    CHECK(screened.objective.simulations <= 24);
    if (!found) continue;
    ++called;
    CHECK(found->above);
    CHECK(found->measured == Approx(10));
    CHECK(found->likely == Approx(mean_height(found->nearest) + 30).margin(15));
    CHECK(found->at_best > 15);
    for (const OutOfReach::Bound& bound : found->bounds) named += bound.parameter == 0 && !bound.upper ? 1 : 0;
    CHECK_THAT(describe(*found, reading, parameters),
               Catch::Contains("step1.height_mm is out of reach") && Catch::Contains("10"));
  }
  CAPTURE(called, named);
  CHECK(called >= 38);
  CHECK(named >= 36);
}

TEST_CASE("what some material does is never called out of reach") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    const double height = seed % 2 == 0 ? 38 + 30 * uniform(seed, 7) : 299 - 15 * uniform(seed, 7);  // near the ends
    Synthetic objective = fake_slump(height, seed);
    objective.level = seed % 3 == 0 ? 40 : 0;  // some end early
    Screening screened(objective, seed);
    CHECK_FALSE(screened.out_of_reach());
  }
}

TEST_CASE("a height above a narrowed upper bound is out of reach, and that bound is named") {
  const double level = GENERATE(0.0, 40.0);  // 40: all of the screening may end early
  int called = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Synthetic weak = fake_slump(290, seed);
    weak.level = level;
    const auto wide = weak.observe;
    weak.fails = [](const UnitPoint&, std::uint64_t) { return false; };
    weak.observe = [wide](const UnitPoint& x, std::uint64_t packing) {
      UnitPoint inside = x;
      inside[0] *= 0.5;  // strengths up to the middle of the range
      return wide(inside, packing);
    };
    Screening screened(weak, seed);
    const auto found = screened.out_of_reach();
    if (!found) continue;
    ++called;
    CHECK_FALSE(found->above);
    CHECK_THAT(describe(*found, reading, parameters), Catch::Contains("the upper bound of strength_pa"));
  }
  CHECK(called >= 15);
}

TEST_CASE("a tolerance wider than the error leaves nothing out of reach") {
  Synthetic slump = fake_slump(10, 3);
  slump.tolerance_mm = 60;
  Screening screened(std::move(slump), 3);
  CHECK_FALSE(screened.out_of_reach());
}

TEST_CASE("a reading that every material misses by more than its tolerance is out of reach, alone or one of four") {
  for (const bool alone : {true, false}) {
    CAPTURE(alone);
    Synthetic objective = fake_slump(10, 1);
    objective.measured = alone ? std::vector{10.0} : std::vector{10.0, 50.0, 50.0, 50.0};
    objective.standard_deviations.assign(objective.measured.size(), 1);
    objective.fails = [](const UnitPoint&, std::uint64_t) { return false; };
    objective.observe = [alone](const UnitPoint& x, std::uint64_t packing) {
      std::vector<double> readings(alone ? 1 : 4, 50 + 0.1 * uniform(packing, 3));
      readings[0] = 18 + 20 * x[0];  // 1.6 tolerances too much at best
      return readings;
    };
    Screening screened(objective, 1);
    const auto found = screened.out_of_reach();
    REQUIRE(found);
    CHECK(found->reading == 0);
  }
}

TEST_CASE("a search that would be in vain ends after the screening, and says so", "[campaign]") {
  int ended = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Synthetic objective = too_stiff(seed);
    SearchOptions options;
    options.seed = seed;
    std::string told;
    const Calibration calibration = search(
        objective, options, [&](const Progress& progress) { told += progress.note; }, reading, parameters);
    CHECK(calibration.status == CalibrationStatus::out_of_reach);
    CHECK_FALSE(told.empty());
    if (calibration.reason.find("not started") == std::string::npos) continue;
    ++ended;
    CHECK(objective.simulations <= 30);
    CHECK(calibration.confirmation.packings.size() == 4);
    CHECK(calibration.best.error < 14);
  }
  CHECK(ended >= 15);
}

namespace {

/// As thin mortar pats: what is weak never comes to rest, unless it rolls badly (coordinate 1 above 0.85). The weaker
/// ones of those that come to rest read what the laboratory has; all strong ones come to rest and read far more.
Synthetic seldom_at_rest(std::uint64_t seed) {
  Synthetic objective = fake_slump(100, seed);
  objective.fails = [](const UnitPoint& x, std::uint64_t) { return x[0] < 0.75 && x[1] < 0.85; };
  return objective;
}

/// As a shear cell: only the softest fifth comes to its end; the reading falls to the laboratory's with coordinate 2.
Synthetic soft_alone(std::uint64_t seed) {
  Synthetic objective = fake_slump(60, seed);
  objective.fails = [](const UnitPoint& x, std::uint64_t) { return x[3] > 0.2; };
  objective.observe = [seed](const UnitPoint& x, std::uint64_t packing) {
    const double fall = 1 / (1 + std::exp(-12 * (x[2] - 0.8)));
    return std::vector<double>{250 - 200 * fall + 3 * normal(digest(x), hash_of(seed, packing))};
  };
  return objective;
}

/// The first packing stands; the others of what is weak flow beyond what the laboratory reads.
Synthetic first_packing_stands(std::uint64_t seed) {
  Synthetic objective = fake_slump(60, seed);
  objective.observe = [seed](const UnitPoint& x, std::uint64_t packing) {
    const double height = 150 + 100 * x[0] + 2 * normal(digest(x), hash_of(seed, packing));
    return std::vector<double>{packing == seed * 1000 + 1 ? height : height - 110};
  };
  objective.fails = [](const UnitPoint&, std::uint64_t) { return false; };
  return objective;
}

SearchOptions eighty_simulations(std::uint64_t seed) {
  SearchOptions options;
  options.seed = seed;
  options.budget_simulations = 80;
  return options;
}

}  // namespace

TEST_CASE("a laboratory that few candidates meet while most fail is not called out of reach", "[campaign]") {
  const auto made = GENERATE(seldom_at_rest, soft_alone);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Synthetic objective = made(seed);
    const Calibration calibration = search(objective, eighty_simulations(seed), {}, reading, parameters);
    CAPTURE(seed, calibration.simulations, calibration.reason);
    CHECK(calibration.status != CalibrationStatus::out_of_reach);
    CHECK(std::ranges::any_of(calibration.history, &Response::failed));
  }
}

TEST_CASE("what is out of reach is called so after a third of the budget, whether or not some candidates fail") {
  const bool some_fail = GENERATE(true, false);
  int early = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Synthetic objective = too_stiff(seed);
    if (!some_fail) objective.fails = [](const UnitPoint&, std::uint64_t) { return false; };
    const Calibration calibration = search(objective, eighty_simulations(seed), {}, reading, parameters);
    CAPTURE(seed, calibration.reason);
    if (calibration.status == CalibrationStatus::out_of_reach && calibration.simulations <= 34) ++early;
  }
  CHECK(early == 10);
}

TEST_CASE("a claim that a later simulation contradicts is withdrawn, and the search goes on to the material",
          "[campaign]") {
  int withdrawn = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Synthetic objective = first_packing_stands(seed);
    std::string told;
    const Calibration calibration = search(
        objective, eighty_simulations(seed), [&](const Progress& progress) { told += progress.note; }, reading,
        parameters);
    CAPTURE(seed, told, calibration.reason);
    CHECK(calibration.status != CalibrationStatus::out_of_reach);
    CHECK(calibration.reason.find("out of reach") == std::string::npos);
    if (told.find("is out of reach") == std::string::npos) continue;
    ++withdrawn;
    CHECK_THAT(told, Catch::Contains("the search continues"));
    CHECK(calibration.simulations > 24);  // a claim that stands takes 18 to 22
  }
  CHECK(withdrawn >= 5);
}
