#include "calibrate/search/simulated_minimisation.h"

#include <optional>
#include <span>
#include <utility>

namespace pastefit {
namespace {

/// Ends an optimiser that asks for what is not known.
struct NotKnown {};

}  // namespace

bool SimulatedMinimisation::advance() {
  EvaluationHistory& history = state_.history;
  if (std::exchange(asked_, false)) answers_.push_back(answers_of(history.answers()));
  std::size_t question = 0, allowed = 0;
  Problem problem;
  problem.parameters = history.parameters();
  problem.residuals = history.residuals();
  problem.refuses = [&](int points) -> std::optional<Problem::Refusal> {
    if (asked_) return Problem::Refusal{SearchStatus::stopped, "an answer is not known yet"};
    if (allowed == refusals_.size()) refusals_.push_back(refusal_of(points));
    return refusals_[allowed++];
  };
  problem.answer = [&](std::span<const UnitPoint> points) {
    if (question < answers_.size()) return answers_[question++];
    if (!std::exchange(asked_, true)) history.evaluate(points, state_.common);
    throw NotKnown{};
  };
  try {
    minimise_(problem);
  } catch (const NotKnown&) {
  }
  return !asked_;
}

std::vector<Answer> SimulatedMinimisation::answers_of(std::span<const Response> responses) const {
  std::vector<Answer> answers;
  for (const Response& response : responses)
    answers.push_back({response.point, response.misfit, response.residuals, !is_feasible(response),
                       goal_ > 0 && response.error <= goal_});
  return answers;
}

std::optional<Problem::Refusal> SimulatedMinimisation::refusal_of(int points) const {
  if (state_.history.stop_requested()) return Problem::Refusal{SearchStatus::stopped, "a stop was requested"};
  if (!state_.affordable(static_cast<std::size_t>(points) * state_.common.size()))
    return Problem::Refusal{SearchStatus::budget_spent, "the budget of simulations is spent"};
  return std::nullopt;
}

}  // namespace pastefit
