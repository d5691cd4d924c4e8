#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "calibrate/base/statistics.h"
#include "calibrate/judge/verdict.h"
#include "calibrate/optimisers/problem.h"
#include "core/result.h"

namespace pastefit {

/// One finished simulation of a candidate on one packing.
struct Evaluation {
  UnitPoint point;
  std::uint64_t packing = 0;
  std::vector<double> readings;  ///< in the order of the study's measurements; NaN: not taken; empty after a failure
  std::optional<Failure> failure;
  bool censored = false;  ///< see `Objective::try_out`
  int simulations = 1;    ///< that were spent on it; 0: it was known, or cut off by a stop
  /// How near it is to one that a laboratory would repeat, e.g. a heap that sheared off; NaN: not judged.
  double rejection_index = std::numeric_limits<double>::quiet_NaN();

  bool is_rejected() const { return pastefit::is_rejected(rejection_index); }
};

/// What a candidate answers on a set of packings: the mean over those that a laboratory would accept (`accepted`),
/// against the laboratory.
struct Response {
  UnitPoint point;
  std::vector<std::uint64_t> packings;
  std::vector<Evaluation> evaluations;  ///< one per packing
  Eigen::VectorXd readings;             ///< mean over the accepted, one for each reading; NaN: one of them has none
  /// Of the readings sqrt(weight) (mean - measured)/standard deviation; of the priors the distance from their mean in
  /// their standard deviations. Finite; graded if it failed.
  Eigen::VectorXd residuals;
  double misfit = 0;  ///< half the squared norm of the residuals: what is minimised; always finite
  /// Largest difference of a fitted reading from the laboratory over its tolerance: what is judged; 1 is asked for.
  double error = 0;
  /// What the noise of the packings makes of `error` by itself: largest standard error of a fitted reading
  /// over its tolerance. 0: a single packing, or a failure.
  double noise = 0;
  bool failed = false;  ///< some packing ended in a failure
  int rejected = 0;     ///< packings on which a laboratory would repeat the test
  /// Some packing ended early: readings may be missing, with a residual of 0, or be a bound. The misfit is a lower
  /// bound of that of the whole test, and not one that makes a candidate the best.
  bool censored = false;
};

/// True if there is a response, it did not fail, and its numbers are finite.
inline bool is_feasible(const Response& response) {
  return response.point.size() > 0 && !response.failed && std::isfinite(response.misfit) &&
         response.residuals.allFinite();
}

/// True if it is feasible and has all its readings.
inline bool is_whole(const Response& response) {
  return is_feasible(response) && !response.censored;
}

/// True unless reading k was not taken, because a simulation ended early.
inline bool has_reading(const Response& response, Eigen::Index k) {
  return !response.censored || k >= response.readings.size() || !std::isnan(response.readings[k]);
}

/// Those that a laboratory would accept (`judge/verdict.h`).
inline std::vector<const Evaluation*> accepted(std::span<const Evaluation> evaluations) {
  std::vector<bool> rejected;
  for (const Evaluation& one : evaluations) rejected.push_back(one.is_rejected());
  std::vector<const Evaluation*> out;
  for (const std::size_t i : accepted(rejected)) out.push_back(&evaluations[i]);
  return out;
}

/// What it says of its candidate.
inline Evidence evidence_of(const Response& response) {
  Evidence out{.error = response.error, .noise = response.noise, .whole = is_whole(response)};
  for (const Evaluation& one : response.evaluations) out.add_heap(one.rejection_index);
  return out;
}

/// Square of the standard error of a mean reading, from its scatter over the accepted packings:
/// sum (x - mean)^2/(n (n - 1)). 0 for a single packing, a failure, or a reading that was not taken.
inline double squared_standard_error(const Response& response, std::size_t reading) {
  const auto judged = accepted(response.evaluations);
  if (judged.size() < 2 || response.failed) return 0;
  std::vector<double> values;
  for (const Evaluation* one : judged) values.push_back(one->readings[reading]);
  const Sample sample = sample_of(values);
  const double square = sample.standard_deviation * sample.standard_deviation / sample.count;
  return std::isfinite(square) ? square : 0;
}

/// True if `candidate` should replace `best`: one with all its readings beats one without, feasible beats failed, then
/// less misfit wins. An empty `best` loses.
inline bool is_better(const Response& candidate, const Response& best) {
  if (best.point.size() == 0) return true;
  if (is_whole(candidate) != is_whole(best)) return is_whole(candidate);
  if (is_feasible(candidate) != is_feasible(best)) return is_feasible(candidate);
  return candidate.misfit < best.misfit;
}

}  // namespace pastefit
