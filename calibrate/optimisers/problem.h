#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace pastefit {

/// Point in the unit cube of the free parameters.
using UnitPoint = Eigen::VectorXd;

inline std::span<const double> coordinates(const UnitPoint& point) {
  return {point.data(), static_cast<std::size_t>(point.size())};
}

/// Value of a problem at a point.
struct Answer {
  UnitPoint point;
  double value = 0;           ///< minimised, >= 0; for least squares half the sum of squared residuals
  Eigen::VectorXd residuals;  ///< for least squares; else empty
  bool failed = false;        ///< the value does not count; it may grade the failure
  bool good_enough = false;   ///< the run may end here
};

/// True if it did not fail and is finite.
inline bool is_feasible(const Answer& answer) {
  return answer.point.size() > 0 && !answer.failed && std::isfinite(answer.value) && answer.residuals.allFinite();
}

/// True if `candidate` should replace `best`: feasible beats failed, then the smaller value wins. A `best` without a
/// point loses.
inline bool is_better(const Answer& candidate, const Answer& best) {
  if (best.point.size() == 0) return true;
  if (is_feasible(candidate) != is_feasible(best)) return is_feasible(candidate);
  return candidate.value < best.value;
}

/// Function over the unit cube to be minimised.
struct Problem {
  int parameters = 1;
  int residuals = 0;  ///< for least squares
  /// Evaluates points, all at once so that they can run in parallel; in their order.
  std::function<std::vector<Answer>(std::span<const UnitPoint>)> answer;
  /// True if this number of further points may be evaluated; false ends the run. May be left empty.
  std::function<bool(int points)> may_evaluate;
};

/// Problem with one cheap number for each point; it cannot fail. The value should be >= 0; optimisers resolve values up
/// to that of the start best.
inline Problem scalar_problem(int parameters, std::function<double(const UnitPoint&)> value) {
  Problem problem;
  problem.parameters = parameters;
  problem.answer = [value = std::move(value)](std::span<const UnitPoint> points) {
    std::vector<Answer> answers;
    for (const UnitPoint& point : points) answers.push_back({.point = point, .value = value(point), .residuals = {}});
    return answers;
  };
  return problem;
}

/// Result of one run of an optimiser.
struct Optimum {
  Answer best;  ///< feasible answer of least value; a failed one only if all failed; no point if none was evaluated
  int evaluations = 0;  ///< points evaluated
};

}  // namespace pastefit
