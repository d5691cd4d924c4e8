#include <catch2/catch.hpp>
#include <cmath>

#include "calibrate/search/search.h"
#include "tests/calibrate/search/synthetic.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

/// A test in which nothing is random: every packing answers the same, to the last bit.
Synthetic deterministic(const UnitPoint& truth) {
  Synthetic objective;
  objective.observe = [](const UnitPoint& at, std::uint64_t) {
    return std::vector<double>{500 * at[0] * at[0], 300 * at[0] * at[1], 40 * at[1]};
  };
  objective.measured = objective.observe(truth, 0);
  objective.standard_deviations = {5, 5, 2};
  objective.tolerance_mm = 2;
  objective.budget = 200;
  return objective;
}

SearchOptions options() {
  SearchOptions options;
  options.budget_simulations = 200;
  options.packings = 1;
  options.confirmation_packings = 2;
  options.tolerance_mm = 2;
  return options;
}

bool all_finite(const Calibration& calibration) {
  return std::ranges::all_of(calibration.history, [](const Response& one) {
    return one.point.allFinite() && one.residuals.allFinite() && std::isfinite(one.misfit) &&
           one.noise < 1e-12;  // a mean of equal numbers rounds
  });
}

}  // namespace

TEST_CASE("a test without any noise is calibrated and confirmed, with one packing a candidate or several") {
  for (const int packings : {1, 3}) {
    for (const double first : {0.35, 0.8}) {
      CAPTURE(packings, first);
      Synthetic objective = deterministic(Eigen::Vector2d(first, 0.4));
      SearchOptions wanted = options();
      wanted.packings = packings;
      const Calibration calibration = search(objective, wanted);
      CHECK(calibration.status == CalibrationStatus::confirmed);
      CHECK(calibration.confirmation.noise == 0);
      CHECK(calibration.best.point[0] == Approx(first).margin(0.02));
      CHECK(all_finite(calibration));
    }
  }
}

TEST_CASE("where a test without noise cannot be met the reason is no scatter", "[campaign]") {
  Synthetic objective = deterministic(Eigen::Vector2d(0.5, 0.5));
  objective.measured[2] = 60;  // beyond 40
  const Calibration beyond = search(objective, options());
  CHECK(beyond.status == CalibrationStatus::out_of_reach);
  CHECK_THAT(beyond.reason, !Catch::Contains("scatter"));
  CHECK(all_finite(beyond));

  Synthetic at_odds = deterministic(Eigen::Vector2d(0.5, 0.5));
  at_odds.measured[1] += 40;  // each reading can be met, all three together cannot
  const Calibration missed = search(at_odds, options());
  CHECK(missed.status != CalibrationStatus::confirmed);
  CHECK_THAT(missed.reason, !Catch::Contains("scatter"));
  CHECK(all_finite(missed));
}
