#include "calibrate/optimisers/problem.h"

#include <cmath>
#include <utility>

namespace pastefit {

bool is_feasible(const Answer& answer) {
  return answer.point.size() > 0 && !answer.failed && std::isfinite(answer.value) && answer.residuals.allFinite();
}

bool is_better(const Answer& candidate, const Answer& best) {
  if (best.point.size() == 0) return true;
  if (is_feasible(candidate) != is_feasible(best)) return is_feasible(candidate);
  return candidate.value < best.value;
}

Problem scalar_problem(int parameters, std::function<double(const UnitPoint&)> value) {
  Problem problem;
  problem.parameters = parameters;
  problem.answer = [value = std::move(value)](std::span<const UnitPoint> points) {
    std::vector<Answer> answers;
    for (const UnitPoint& point : points) answers.push_back({.point = point, .value = value(point), .residuals = {}});
    return answers;
  };
  return problem;
}

}  // namespace pastefit
