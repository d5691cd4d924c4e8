#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "calibrate/optimisers/problem.h"
#include "tests/calibrate/search/objective.h"

namespace pastefit {

/// The misfit, and the residuals, of candidates on these packings as a problem for an optimiser.
/// `simulations`: an `Objective`. `goal`: a feasible error at or below it is good enough; 0: none
/// is. Requirements: packings are given; `simulations` and `packings` outlive the problem. Refuses when a stop is
/// requested, and what the budget does not allow.
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
  problem.refuses = [&simulations, packings](int points) -> std::optional<Problem::Refusal> {
    if (simulations.stop_requested()) return Problem::Refusal{SearchStatus::stopped, "a stop was requested"};
    if (simulations.budget_left() < points * static_cast<int>(packings.size()))
      return Problem::Refusal{SearchStatus::budget_spent, "the budget of simulations is spent"};
    return std::nullopt;
  };
  return problem;
}

}  // namespace pastefit
