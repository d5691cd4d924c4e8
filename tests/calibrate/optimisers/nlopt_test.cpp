#include <catch2/catch.hpp>
#include <stdexcept>

#include "../search/synthetic.h"
#include "calibrate/optimisers/problem.h"
#include "tests/calibrate/optimisers/simulated_problem.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

UnitPoint point_of(std::initializer_list<double> coordinates) {
  UnitPoint point(static_cast<Eigen::Index>(coordinates.size()));
  std::copy(coordinates.begin(), coordinates.end(), point.begin());
  return point;
}

NloptOptions options_for(std::string_view algorithm, int evaluations) {
  NloptOptions options;
  options.algorithm = algorithm;
  options.evaluations = evaluations;
  return options;
}

/// The least feasible misfit among all that was answered; infinite if there is none.
double least_seen(const Synthetic& objective) {
  double least = std::numeric_limits<double>::infinity();
  for (const Response& response : objective.answered) {
    if (is_feasible(response)) least = std::min(least, response.misfit);
  }
  return least;
}

}  // namespace

TEST_CASE("every algorithm finds the bottom of a bowl") {
  for (const std::string_view name : nlopt_algorithm_names()) {
    CAPTURE(name);
    for (const int dimension : {1, 2, 5}) {
      CAPTURE(dimension);
      UnitPoint target(dimension);
      for (int k = 0; k < dimension; ++k) target[k] = 0.3 + 0.1 * k;
      Synthetic objective = bowl(target);
      const Optimum run = minimise(simulated_problem(objective, one_packing), UnitPoint::Constant(dimension, 0.9),
                                   options_for(name, 1500));
      CHECK(run.best.value < 0.02);
      CHECK(run.best.value == least_seen(objective));
      CHECK(run.evaluations == static_cast<int>(objective.answered.size()));
      CHECK(run.evaluations <= 1500);
    }
  }
}

TEST_CASE("no algorithm hangs, meets a number that is not finite, or loses its best when points fail") {
  for (const std::string_view name : nlopt_algorithm_names()) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      CAPTURE(name, seed);
      FailingBowl failing(seed);
      Synthetic& objective = failing.objective;
      const UnitPoint& start = failing.start;
      const Optimum run = minimise(simulated_problem(objective, one_packing), start, options_for(name, 120));
      CHECK(objective.answered.size() <= 120);
      CHECK(run.evaluations == static_cast<int>(objective.answered.size()));
      const double least = least_seen(objective);
      CHECK(is_feasible(run.best) == std::isfinite(least));
      if (std::isinf(least)) continue;
      CHECK(run.best.value == least);
    }
  }
}

TEST_CASE("an algorithm ends with the evaluations, the budget or the wish to stop, whichever comes first") {
  for (const std::string_view name : nlopt_algorithm_names()) {
    CAPTURE(name);
    Synthetic objective = bowl(point_of({0.31, 0.62}));
    objective.budget = 21;
    const std::vector<std::uint64_t> packings{1, 2};
    (void)minimise(simulated_problem(objective, packings), point_of({0.9, 0.9}), options_for(name, 500));
    CHECK(objective.simulations == 20);

    objective = bowl(point_of({0.31, 0.62}));
    objective.stop = [&] { return objective.simulations >= 7; };
    const Optimum run =
        minimise(simulated_problem(objective, one_packing), point_of({0.9, 0.9}), options_for(name, 500));
    CHECK(objective.simulations == 7);
    CHECK(run.best.value == least_seen(objective));
  }
}

TEST_CASE("a goal ends the run at the first point that meets it") {
  Synthetic objective = bowl(point_of({0.31, 0.62}));
  NloptOptions options = options_for("nelder_mead", 500);
  const Optimum run = minimise(simulated_problem(objective, one_packing, 0.02), point_of({0.9, 0.9}), options);
  CHECK(objective.answered.back().error <= 0.02);
  CHECK(objective.answered.back().misfit == run.best.value);
}

TEST_CASE("the same search asks the same points") {
  for (const std::string_view name : nlopt_algorithm_names()) {
    CAPTURE(name);
    Synthetic first = valley(), second = valley();
    minimise(simulated_problem(first, one_packing), point_of({0.2, 0.9}), options_for(name, 150));
    minimise(simulated_problem(second, one_packing), point_of({0.2, 0.9}), options_for(name, 150));
    REQUIRE(first.answered.size() == second.answered.size());
    for (std::size_t k = 0; k < first.answered.size(); ++k) CHECK(first.answered[k].point == second.answered[k].point);
  }
}

TEST_CASE("what the objective throws comes out unchanged") {
  Synthetic objective = bowl(point_of({0.31, 0.62}));
  objective.fails = [&](const UnitPoint&, std::uint64_t) {
    if (objective.simulations > 5) throw std::out_of_range("broken");
    return false;
  };
  for (const std::string_view name : nlopt_algorithm_names()) {
    objective.simulations = 0;
    CHECK_THROWS_AS(minimise(simulated_problem(objective, one_packing), point_of({0.9, 0.9}), options_for(name, 100)),
                    std::out_of_range);
  }
}
