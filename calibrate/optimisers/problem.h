#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pastefit {

/// Point in the unit cube of the free parameters.
using UnitPoint = Eigen::VectorXd;

inline std::span<const double> coordinates(const UnitPoint& point) {
  return {point.data(), static_cast<std::size_t>(point.size())};
}

/// How a run of an optimiser ended; each optimiser's status is translated into one of these.
enum class SearchStatus {
  converged,     ///< goal met, or the algorithm's own test holds and no neighbour of the best point is better
  stalled,       ///< no improvement beyond the noise, or a claim of convergence that was refuted or not checked
  budget_spent,  ///< limit on evaluations, or the problem's own budget
  stopped,       ///< the user or a limit requested it
  failed         ///< no feasible point, or the algorithm rejected the problem
};

/// Name in files and messages, e.g. "budget_spent".
std::string_view name_of(SearchStatus status);

/// Value of a problem at a point.
struct Answer {
  UnitPoint point;
  double value = 0;           ///< minimised, >= 0; for least squares half the sum of squared residuals
  Eigen::VectorXd residuals;  ///< for least squares; else empty
  bool failed = false;        ///< the value does not count; it may grade the failure
  bool good_enough = false;   ///< the run may end here
};

/// True if it did not fail and is finite.
bool is_feasible(const Answer& answer);

/// True if `candidate` should replace `best`: feasible beats failed, then the smaller value wins. A `best` without a
/// point loses.
bool is_better(const Answer& candidate, const Answer& best);

/// Function over the unit cube to be minimised.
struct Problem {
  int parameters = 1;
  int residuals = 0;  ///< for least squares
  /// Evaluates points, all at once so that they can run in parallel; in their order.
  std::function<std::vector<Answer>(std::span<const UnitPoint>)> answer;
  /// Why this number of further points is refused (`stopped` or `budget_spent`); empty: allowed. May be left empty.
  struct Refusal {
    SearchStatus status = SearchStatus::stopped;
    std::string reason;
  };
  std::function<std::optional<Refusal>(int points)> refuses;
};

/// Problem with one cheap number for each point; it cannot fail. The value should be >= 0; optimisers resolve values up
/// to that of the start best.
Problem scalar_problem(int parameters, std::function<double(const UnitPoint&)> value);

/// Result of one run of an optimiser.
struct Optimum {
  Answer best;  ///< feasible answer of least value; a failed one only if all failed
  SearchStatus status = SearchStatus::failed;
  std::string reason;   ///< one sentence for the user
  int evaluations = 0;  ///< points evaluated
  int failures = 0;     ///< of them failed
};

}  // namespace pastefit
