#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

// Trust region of Ceres, on the residuals.

/// Method for the step within the trust region.
enum class TrustRegion { levenberg_marquardt, dogleg };

/// Trust region of a strategy name; empty for names of other strategies.
std::optional<TrustRegion> trust_region_of(std::string_view strategy);

struct CeresOptions {
  TrustRegion trust_region = TrustRegion::levenberg_marquardt;
  double difference_step = 0.1;  ///< finite difference step in the unit cube; 0 < step <= 0.5; see `noise_step`
  double step_tolerance = 0.01;  ///< shorter steps, in the unit cube, end the run; > 0
  int evaluations = 100;         ///< most points evaluated, start and finite differences included; > 0
  double noise = 0;              ///< an accepted step that improves the value by no more ends the run; >= 0
};

/// Step at which the error of a one-sided difference is least: 2 sqrt(noise/curvature), within [0.01, 0.5]. noise:
/// standard deviation of one residual; curvature: its second derivative in the unit cube; both >= 0. Source: balances 2
/// noise/h against h curvature/2 (Moré & Wild, ACM TOMS 38 (2012) 19).
double noise_step(double noise, double curvature);

/// Minimises half the squared residuals of a problem over the unit cube, from `start`, with a trust region.
/// Requirements: `start` lies in the unit cube, the problem has residuals, the options have values as stated. The
/// Jacobian is by finite differences: all probes of a point are evaluated at once, in parallel, each towards the
/// farther border. A probe that fails is tried on the other side, then on both with a quarter of the step; a column
/// without an answer is zero, so that the parameter is held. A trial point that fails costs twice the worst answer so
/// far, so that Ceres takes a shorter step. A start that fails ends the run at once. Throws what the problem throws,
/// and std::logic_error if a requirement is broken.
Optimum minimise(const Problem& problem, const UnitPoint& start, const CeresOptions& options);

// Algorithms of NLopt, on the value.

struct NloptOptions {
  std::string algorithm = "bobyqa";  ///< one of `nlopt_algorithm_names()`
  int evaluations = 100;             ///< most points evaluated, start included; > 0
  double initial_step = 0.2;         ///< first step of the local algorithms, in the unit cube; 0 < step <= 0.5
  double step_tolerance = 1e-3;      ///< shorter steps, in the unit cube, end the run; > 0
  std::uint64_t seed = 1;            ///< of randomised algorithms
};

/// Names of the algorithms, in a fixed order: two global and four local ones of NLopt's that suit expensive functions.
std::vector<std::string_view> nlopt_algorithm_names();

/// Minimises a problem over the unit cube, from `start`. Requirements: the algorithm is known, `start` lies in the
/// unit cube. NLopt gets f/(f + f_start) instead of the value f, between 0 and 1, and 1 to 2 for a failure. This is
/// bounded, keeps the order and does not change during the run, so that a failure is worse than any answer without a
/// cliff that depends on the units. Points outside the cube are moved to its border; points that are not numbers are
/// not evaluated. The best answer is recorded here, not taken from NLopt. After a claim of convergence the
/// neighbours of the best point, a quarter of `initial_step` away, are evaluated as well. Limit: an algorithm that
/// loops without evaluating a point cannot be stopped; none is known to do so for bounded values. Throws what the
/// problem throws, and std::logic_error if a requirement is broken.
Optimum minimise(const Problem& problem, const UnitPoint& start, const NloptOptions& options);

/// Minimiser of a cheap function: DIRECT_L over the cube, then BOBYQA from there.
UnitPoint least_point(const std::function<double(const UnitPoint&)>& function, const UnitPoint& start);

}  // namespace pastefit
