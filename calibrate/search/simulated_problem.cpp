#include "calibrate/search/simulated_problem.h"

#include <optional>
#include <stdexcept>
#include <vector>

namespace pastefit {

Problem simulated_problem(Objective& objective, std::span<const std::uint64_t> packings, double goal) {
  if (packings.empty()) throw std::logic_error("simulated_problem: needs packings");
  Problem problem;
  problem.parameters = objective.parameters();
  problem.residuals = objective.residuals();
  problem.answer = [&objective, packings, goal](std::span<const UnitPoint> points) {
    std::vector<Answer> answers;
    for (const Response& response : objective.evaluate(points, packings))
      answers.push_back({response.point, response.misfit, response.residuals, !is_feasible(response),
                         goal > 0 && response.miss <= goal});
    return answers;
  };
  problem.refuses = [&objective, packings](int points) -> std::optional<Problem::Refusal> {
    if (objective.stop_requested()) return Problem::Refusal{SearchStatus::stopped, "a stop was requested"};
    if (objective.budget_left() < points * static_cast<int>(packings.size()))
      return Problem::Refusal{SearchStatus::budget_spent, "the budget of simulations is spent"};
    return std::nullopt;
  };
  return problem;
}

}  // namespace pastefit
