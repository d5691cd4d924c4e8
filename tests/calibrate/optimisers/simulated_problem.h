#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "calibrate/optimisers/problem.h"
#include "tests/calibrate/search/objective.h"

namespace pastefit {

/// The misfit, and the residuals, of candidates on these packings as a problem for an optimiser.
/// `simulations`: an `Objective`. `goal`: a feasible error at or below it is good enough; 0: none
/// is. Requirements: packings are given; `simulations` and `packings` outlive the problem. It may not be evaluated
/// further when a stop is requested, or beyond the budget.
inline Problem simulated_problem(Objective& simulations, std::span<const std::uint64_t> packings, double goal = 0) {
  if (packings.empty()) throw std::logic_error("simulated_problem: needs packings");
  Problem problem;
  problem.parameters = simulations.parameters();
  problem.residuals = simulations.residuals();
  problem.answer = [&simulations, packings, goal](std::span<const UnitPoint> points) {
    std::vector<Answer> answers;
    for (const Response& response : simulations.evaluate(points, packings))
      answers.push_back({response.point, response.misfit, response.residuals, !is_feasible(response),
                         goal > 0 && response.error <= goal});
    return answers;
  };
  problem.may_evaluate = [&simulations, packings](int points) {
    return !simulations.stop_requested() && simulations.budget_left() >= points * static_cast<int>(packings.size());
  };
  return problem;
}

}  // namespace pastefit
