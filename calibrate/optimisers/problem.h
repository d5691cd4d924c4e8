#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pastefit {

/// A point of the unit cube over some parameters.
using UnitPoint = Eigen::VectorXd;

inline std::span<const double> coordinates(const UnitPoint& point) {
  return {point.data(), static_cast<std::size_t>(point.size())};
}

/// How one optimiser's run ended; every status of every optimiser is translated into one of these.
enum class SearchStatus {
  converged,     ///< the goal is met, or the algorithm's own test holds and a look around the best point agrees
  stalled,       ///< no improvement beyond the noise, or a claim of convergence that was refuted or not checked
  budget_spent,  ///< the bound on evaluations, or the problem's own budget
  stopped,       ///< the user or a limit asked for it
  failed         ///< no feasible point was seen, or the algorithm refused
};

/// The status as it is stored and printed, e.g. "budget_spent".
std::string_view name_of(SearchStatus status);

/// What an optimiser is told of a point.
struct Answer {
  UnitPoint point;
  double value = 0;           ///< what is minimised, >= 0; of a least-squares problem half the sum of squared residuals
  Eigen::VectorXd residuals;  ///< of a least-squares problem; else empty
  bool failed = false;        ///< it has no value that counts; `value` may grade the failure
  bool good_enough = false;   ///< the run may end with it
};

/// True if it did not fail and its numbers are finite.
bool is_feasible(const Answer& answer);

/// True if `candidate` should replace `best`: feasible beats failed, then the smaller value wins. A `best` without a
/// point loses.
bool is_better(const Answer& candidate, const Answer& best);

/// A function over the unit cube, as an optimiser sees it.
struct Problem {
  int parameters = 1;
  int residuals = 0;  ///< of a least-squares problem
  /// Answers points, all at once, so that they can be worked on in parallel; in their order.
  std::function<std::vector<Answer>(std::span<const UnitPoint>)> answer;
  /// Why so many more points are not answered; empty: they are. `stopped` or `budget_spent`. May be left empty.
  struct Refusal {
    SearchStatus status = SearchStatus::stopped;
    std::string reason;
  };
  std::function<std::optional<Refusal>(int points)> refuses;
};

/// A number for each point, which never fails and costs nothing. It should be >= 0: an optimiser compares, and sees
/// values up to that of its start best.
Problem scalar_problem(int parameters, std::function<double(const UnitPoint&)> value);

/// What one optimiser's run brought.
struct Optimum {
  Answer best;  ///< the feasible answer of least value that was seen; a failed one only if all failed
  SearchStatus status = SearchStatus::failed;
  std::string reason;   ///< one sentence for a person
  int evaluations = 0;  ///< points asked
  int failures = 0;     ///< of them failed
};

}  // namespace pastefit
