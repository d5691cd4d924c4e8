#include "calibrate/search/confirmation.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "calibrate/base/statistics.h"
#include "calibrate/models/exceedance.h"
#include "calibrate/search/response.h"

namespace pastefit {
namespace {

// Probabilities that the share of rejected heaps is no larger than it may be, by their count and by how near they came.
constexpr double hardly_within = 0.1, likely_within = 0.5, surely_within = 0.8;

constexpr std::size_t least_heaps = 4;  // of which a scatter is worth something

/// That the share of heaps beyond the limit is no larger than `allowed`, by how many of them are: with an even prior
/// the share has a beta distribution.
double within_by_count(const Response& response, double allowed) {
  const double rejected = response.rejected, heaps = static_cast<double>(response.evaluations.size());
  return boost::math::cdf(boost::math::beta_distribution<>(rejected + 1, heaps - rejected + 1), allowed);
}

/// The same by how near each came to the limit: a normal variable of unknown mean and scatter is beyond it with at most
/// that share (the one-sided tolerance limit, by a noncentral t distribution). None where it cannot be told.
std::optional<double> within_by_index(const Response& response, double allowed) {
  std::vector<double> roots;
  for (const Evaluation& one : response.evaluations)
    if (!std::isnan(one.rejection_index)) roots.push_back(Exceedance::root(one.rejection_index));
  const Sample sample = sample_of(roots);
  if (roots.size() < least_heaps || sample.standard_deviation <= 0) return {};
  const double root_of_count = std::sqrt(sample.count), freedom = sample.count - 1;
  const double needed = boost::math::quantile(boost::math::normal_distribution<>(), 1 - allowed);
  const double margin = (1 - sample.mean) / sample.standard_deviation;
  constexpr double certain = 1e3;
  const double place = root_of_count * margin;
  if (std::abs(place) > certain) return place > 0 ? 1 : 0;
  return boost::math::cdf(boost::math::non_central_t_distribution<>(freedom, root_of_count * needed), place);
}

}  // namespace

Verdict verdict_on(const Response& response, double rejected_share) {
  if (!is_whole(response)) return Verdict::refuted;
  // Of a single heap that is left of many the scatter is not known.
  const bool known = accepted(response.evaluations).size() > 1 || response.evaluations.size() == 1;
  const Verdict of_readings = verdict_on(response.normalised_error, response.noise);
  const Verdict readings = known || of_readings == Verdict::refuted ? of_readings : Verdict::undecided;
  if (readings == Verdict::refuted || rejected_share >= 1) return readings;
  const double by_count = within_by_count(response, rejected_share);
  const double by_index = within_by_index(response, rejected_share).value_or(by_count);
  if (std::min(by_count, by_index) < hardly_within) return Verdict::refuted;
  return by_index >= surely_within && by_count >= likely_within ? readings : Verdict::undecided;
}

Verdict verdict_on(double normalised_error, double noise) {
  if (std::hypot(1, noise) < normalised_error) return Verdict::refuted;
  return std::hypot(normalised_error, noise) <= 1 ? Verdict::holds : Verdict::undecided;
}

double shortfall(const Response& response, double rejected_share) {
  if (!is_whole(response)) return std::numeric_limits<double>::infinity();
  if (response.rejected == 0 || rejected_share >= 1) return response.normalised_error;
  const double share = static_cast<double>(response.rejected) / static_cast<double>(response.evaluations.size());
  return std::max(response.normalised_error, share / rejected_share);
}

double packings_to_decide(const Response& response) {
  constexpr double least = 1e-6;  // where no number of packings would tell
  const double left = std::abs(1 - response.normalised_error * response.normalised_error);
  return static_cast<double>(response.packings.size()) * response.noise * response.noise / std::max(left, least);
}

}  // namespace pastefit
