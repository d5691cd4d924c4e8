#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "../search/synthetic.h"
#include "calibrate/optimisers/problem.h"
#include "tests/calibrate/optimisers/simulated_problem.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

CeresOptions fine_options() {
  CeresOptions options;
  options.difference_step = 1e-6;
  options.step_tolerance = 1e-8;
  options.evaluations = 2000;
  return options;
}

std::ptrdiff_t failures_of(const Synthetic& objective) {
  return std::ranges::count_if(objective.answered, &Response::failed);
}

}  // namespace

TEST_CASE("both trust regions walk Rosenbrock's valley to its end") {
  for (const TrustRegion region : {TrustRegion::levenberg_marquardt, TrustRegion::dogleg}) {
    Synthetic objective = valley();
    CeresOptions options = fine_options();
    options.trust_region = region;
    const Optimum run = minimise(simulated_problem(objective, one_packing), Eigen::Vector2d(0.2, 0.8), options);
    CHECK(run.best.value < 1e-8);
  }
}

TEST_CASE("a minimum outside the cube is met at its border") {
  Synthetic objective = bowl(Eigen::Vector2d(0.4, 1.7));
  const Optimum run = minimise(simulated_problem(objective, one_packing), Eigen::Vector2d(0.9, 0.1), fine_options());
  CHECK(run.best.point[0] == Approx(0.4).margin(1e-3));
  CHECK(run.best.point[1] == Approx(1.0).margin(1e-3));
}

TEST_CASE("a probe that fails is replaced by one on the other side, and by a shorter one") {
  Synthetic objective = bowl(Eigen::Vector2d(0.2, 0.2));
  CeresOptions options;
  options.difference_step = 0.2;
  objective.fails = [](const UnitPoint& x, std::uint64_t) { return x[0] > 0.45 || x[1] > 0.75; };
  Optimum run = minimise(simulated_problem(objective, one_packing), Eigen::Vector2d(0.4, 0.6), options);
  CHECK(failures_of(objective) >= 1);
  CHECK(run.best.value < 1e-4);
  objective = bowl(Eigen::Vector2d(0.2, 0.2));
  objective.fails = [](const UnitPoint& x, std::uint64_t) { return x[0] > 0.55 && std::abs(x[1] - 0.5) > 0.06; };
  run = minimise(simulated_problem(objective, one_packing), Eigen::Vector2d(0.6, 0.5), options);
  CHECK(failures_of(objective) >= 2);
  CHECK(run.best.value < 1e-4);
}

TEST_CASE("a direction in which everything fails is held") {
  Synthetic objective = bowl(Eigen::Vector2d(0.2, 0.2));
  objective.fails = [](const UnitPoint& x, std::uint64_t) { return std::abs(x[1] - 0.6) > 1e-6; };
  const Optimum run = minimise(simulated_problem(objective, one_packing), Eigen::Vector2d(0.7, 0.6), CeresOptions{});
  CHECK(run.best.point[0] == Approx(0.2).margin(0.02));
  CHECK(run.best.point[1] == 0.6);
}

TEST_CASE("two hundred failing regions end no solve at its start, and the best is the best that was seen") {
  int improved = 0, feasible_starts = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    FailingBowl failing(seed);
    Synthetic& objective = failing.objective;
    const UnitPoint& start = failing.start;
    CeresOptions options;
    options.trust_region = seed % 2 == 0 ? TrustRegion::levenberg_marquardt : TrustRegion::dogleg;
    options.evaluations = 120;
    const Optimum run = minimise(simulated_problem(objective, one_packing), start, options);
    CHECK(objective.answered.size() <= 120);
    if (objective.fails(start, 1)) {
      CHECK(objective.answered.size() == 1);
      continue;
    }
    ++feasible_starts;
    double least = std::numeric_limits<double>::infinity();
    for (const Response& response : objective.answered) {
      if (is_feasible(response)) least = std::min(least, response.misfit);
    }
    CHECK(is_feasible(run.best));
    CHECK(run.best.value == least);
    if (least < 0.5 * objective.answered[0].misfit) ++improved;
  }
  CHECK(feasible_starts > 80);
  CHECK(improved > 0.85 * feasible_starts);
}

TEST_CASE("a start that meets the goal costs one point") {
  Synthetic objective = bowl(Eigen::Vector2d(0.2, 0.2));
  CeresOptions options;
  const Optimum run = minimise(simulated_problem(objective, one_packing, 0.04), Eigen::Vector2d(0.3, 0.3), options);
  CHECK(run.best.good_enough);
  CHECK(objective.answered.size() == 1);
}

TEST_CASE("budget, stop and exceptions end the solve with what was seen") {
  Synthetic objective = valley();
  objective.budget = 9;
  (void)minimise(simulated_problem(objective, one_packing), Eigen::Vector2d(0.2, 0.8), fine_options());
  CHECK(objective.simulations <= 9);
  objective = valley();
  objective.stop = [&] { return objective.simulations >= 5; };
  const UnitPoint best =
      minimise(simulated_problem(objective, one_packing), Eigen::Vector2d(0.2, 0.8), fine_options()).best.point;
  CHECK(best.size() == 2);
  CHECK(objective.simulations <= 7);
  objective = valley();
  objective.fails = [&](const UnitPoint&, std::uint64_t) {
    if (objective.simulations > 5) throw std::out_of_range("broken");
    return false;
  };
  CHECK_THROWS_AS(minimise(simulated_problem(objective, one_packing), Eigen::Vector2d(0.2, 0.8), fine_options()),
                  std::out_of_range);
}

TEST_CASE("the probe grows with the noise and shrinks with the curvature") {
  CHECK(noise_step(1, 100) == Approx(0.2));
  CHECK(noise_step(4, 400) == Approx(0.2));
  CHECK(noise_step(1, 0) == 0.5);
  CHECK(noise_step(0, 1) == 0.01);
}
