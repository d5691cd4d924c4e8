#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "calibrate/base/statistics.h"
#include "calibrate/judge/verdict.h"
#include "calibrate/optimisers/problem.h"
#include "calibrate/study/tests.h"
#include "core/result.h"

namespace pastefit {

/// Finished simulation of a candidate on one packing.
struct Evaluation {
  UnitPoint point;
  std::uint64_t packing = 0;
  std::vector<double> readings;  ///< one for each measurement of the study; NaN: not taken; empty after a failure
  std::optional<Failure> failure;
  bool censored = false;  ///< see `Simulation::may_end_early`
  int simulations = 1;    ///< spent on it; 0: known before, or cut off by a stop
  /// Rejection index: beyond 1 a laboratory rejects the heap, e.g. because it sheared off; NaN: not judged.
  double rejection_index = std::numeric_limits<double>::quiet_NaN();

  bool is_rejected() const { return pastefit::is_rejected(rejection_index); }
};

/// Response of a candidate to a set of packings: mean over the accepted ones (`accepted`), compared with the
/// measurement.
struct Response {
  UnitPoint point;
  std::vector<std::uint64_t> packings;
  std::vector<Evaluation> evaluations;  ///< one per packing
  Eigen::VectorXd readings;             ///< means over the accepted; NaN: one of them lacks the reading
  /// Readings: sqrt(weight) (mean - measured)/standard deviation. Priors: distance from their mean in their standard
  /// deviations. Always finite; graded after a failure.
  Eigen::VectorXd residuals;
  double misfit = 0;  ///< half the squared norm of the residuals: minimised; always finite
  /// Largest difference of a fitted reading from the measurement over its tolerance: judged; at most 1 is accepted.
  double error = 0;
  /// Largest standard error of a fitted reading over its tolerance. 0: a single packing, or a failure.
  double noise = 0;
  bool failed = false;  ///< some packing failed
  int rejected = 0;     ///< packings whose heap is rejected
  /// Some packing ended early: readings may be missing, with a residual of 0, or be bounds. The misfit is a lower bound
  /// of that of the complete test and cannot make a candidate the best.
  bool censored = false;
};

/// True if the response exists, did not fail, and is finite.
inline bool is_feasible(const Response& response) {
  return response.point.size() > 0 && !response.failed && std::isfinite(response.misfit) &&
         response.residuals.allFinite();
}

inline bool is_whole(const Response& response) {
  return is_feasible(response) && !response.censored;
}

/// True unless reading k is missing because a simulation ended early.
inline bool has_reading(const Response& response, Eigen::Index k) {
  return !response.censored || k >= response.readings.size() || !std::isnan(response.readings[k]);
}

/// Accepted evaluations (`judge/verdict.h`).
inline std::vector<const Evaluation*> accepted(std::span<const Evaluation> evaluations) {
  std::vector<bool> rejected;
  for (const Evaluation& one : evaluations) rejected.push_back(one.is_rejected());
  std::vector<const Evaluation*> out;
  for (const std::size_t i : accepted(rejected)) out.push_back(&evaluations[i]);
  return out;
}

inline Evidence evidence_of(const Response& response) {
  Evidence out{.error = response.error, .noise = response.noise, .whole = is_whole(response)};
  for (const Evaluation& one : response.evaluations) out.add_heap(one.rejection_index);
  return out;
}

/// Squared standard error of a mean reading over the accepted packings: sum (x - mean)^2/(n (n - 1)). 0 for a single
/// packing, a failure, or a missing reading.
inline double squared_standard_error(const Response& response, std::size_t reading) {
  const auto judged = accepted(response.evaluations);
  if (judged.size() < 2 || response.failed) return 0;
  std::vector<double> values;
  for (const Evaluation* one : judged) values.push_back(one->readings[reading]);
  const Sample sample = sample_of(values);
  const double square = sample.standard_deviation * sample.standard_deviation / sample.count;
  return std::isfinite(square) ? square : 0;
}

/// True if `candidate` should replace `best`: complete beats censored, feasible beats failed, then the smaller misfit
/// wins. An empty `best` loses.
inline bool is_better(const Response& candidate, const Response& best) {
  if (best.point.size() == 0) return true;
  if (is_whole(candidate) != is_whole(best)) return is_whole(candidate);
  if (is_feasible(candidate) != is_feasible(best)) return is_feasible(candidate);
  return candidate.misfit < best.misfit;
}

/// Axis-aligned box in the unit cube.
struct UnitBox {
  UnitPoint lower, upper;
};

/// Scores simulations of a study: shapes, tolerances and residuals. Simulates nothing.
class Scoring {
 public:
  virtual ~Scoring() = default;
  virtual int parameters() const = 0;
  virtual int residuals() const = 0;
  /// Number of residuals that are readings; these come first, the others are priors.
  virtual int readings() const { return residuals(); }
  /// Largest accepted difference of a reading, in its unit.
  virtual double tolerance(std::size_t) const { return 1; }
  /// Residual of a reading that differs by its tolerance; 0: not fitted.
  virtual double allowance(std::size_t) const { return 1; }
  /// Unit of errors in messages.
  virtual ErrorUnit error_unit() const { return {}; }
  /// Largest accepted share of rejected heaps; 1: not judged.
  virtual double rejected_share() const { return 1; }
  /// Box of the screening, from prior knowledge; the search may leave it.
  virtual UnitBox likely_box() const { return {UnitPoint::Zero(parameters()), UnitPoint::Ones(parameters())}; }
  /// Simulations of a point on one packing: one for each fitted test.
  virtual int simulations_each() const { return 1; }
  /// Response of one candidate to the packings of these evaluations. Requirement: at least one.
  virtual Response response_of(std::vector<Evaluation> evaluations) const = 0;
};

}  // namespace pastefit
