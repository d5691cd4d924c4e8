#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/statistics.h"
#include "calibrate/search/objective.h"

namespace pastefit {

/// How one optimiser's run ended; every status of every optimiser is translated into one of these.
enum class SearchStatus {
  converged,     ///< the goal is met, or the algorithm's own test holds and a look around the best point agrees
  stalled,       ///< no improvement beyond the noise, or a claim of convergence that was refuted or not checked
  budget_spent,  ///< the bound on evaluations, or the objective's budget
  stopped,       ///< the user or a limit asked for it
  failed         ///< no feasible point was seen, or the algorithm refused
};

/// The status as it is stored and printed, e.g. "budget_spent".
inline std::string_view name_of(SearchStatus status) {
  switch (status) {
    case SearchStatus::converged:
      return "converged";
    case SearchStatus::stalled:
      return "stalled";
    case SearchStatus::budget_spent:
      return "budget_spent";
    case SearchStatus::stopped:
      return "stopped";
    case SearchStatus::failed:
      return "failed";
  }
  return "unknown";
}

/// What one optimiser's run brought.
struct SearchRun {
  Response best;  ///< the feasible response of least misfit that was seen; a failed one only if all failed
  SearchStatus status = SearchStatus::failed;
  std::string reason;   ///< one sentence for a person
  int evaluations = 0;  ///< points asked
  int failures = 0;     ///< of them failed
};

/// True if there is a response, it did not fail, and its numbers are finite.
inline bool is_feasible(const Response& response) {
  return response.point.size() > 0 && !response.failed && std::isfinite(response.misfit) &&
         response.residuals.allFinite();
}

/// True if it is feasible and has all its readings.
inline bool is_whole(const Response& response) {
  return is_feasible(response) && !response.ended_early;
}

/// True unless reading k was not taken, because a simulation ended early.
inline bool has_reading(const Response& response, Eigen::Index k) {
  return !response.ended_early || k >= response.observables.size() || !std::isnan(response.observables[k]);
}

/// Square of the standard error of a mean reading, from its scatter over the packings: sum (x - mean)^2/(n (n - 1)).
/// 0 for a single packing, a failure, or a reading that was not taken.
inline double squared_standard_error(const Response& response, std::size_t reading) {
  if (response.evaluations.size() < 2 || response.failed) return 0;
  std::vector<double> values;
  for (const Evaluation& one : response.evaluations) values.push_back(one.observables[reading]);
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
