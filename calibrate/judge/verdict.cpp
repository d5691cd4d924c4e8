#include "calibrate/judge/verdict.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "calibrate/base/statistics.h"
#include "calibrate/models/gaussian_process.h"

namespace pastefit {
namespace {

// Probabilities that the share of rejected heaps is at most the accepted one, by count and by index.
constexpr double hardly_within = 0.1, likely_within = 0.5, surely_within = 0.8;

constexpr std::size_t least_heaps = 4;  // fewest heaps for an estimate of the scatter

/// Probability that the share of rejected heaps is at most `allowed`, by count: beta distribution with a uniform prior.
double within_by_count(const Evidence& evidence, double allowed) {
  const boost::math::beta_distribution<> share(evidence.rejected + 1, evidence.heaps - evidence.rejected + 1);
  return boost::math::cdf(share, allowed);
}

/// The same by index: a normal variable of unknown mean and scatter exceeds its limit with at most that share
/// (one-sided tolerance limit, noncentral t distribution). None if undetermined.
std::optional<double> within_by_index(const Evidence& evidence, double allowed) {
  std::vector<double> roots;
  for (const double index : evidence.rejection_indices) roots.push_back(Exceedance::root(index));
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

void Evidence::add_reading(double difference, double standard_error, double tolerance) {
  ++readings;
  error = std::max(error, std::abs(difference) / tolerance);
  noise = std::max(noise, standard_error / tolerance);
}

void Evidence::add_heap(double rejection_index) {
  ++heaps;
  rejected += is_rejected(rejection_index) ? 1 : 0;
  if (!std::isnan(rejection_index)) rejection_indices.push_back(rejection_index);
}

std::vector<std::size_t> accepted(const std::vector<bool>& rejected) {
  std::vector<std::size_t> all, good;
  for (std::size_t i = 0; i < rejected.size(); ++i) {
    all.push_back(i);
    if (!rejected[i]) good.push_back(i);
  }
  return good.empty() ? all : good;
}

Verdict verdict_on_readings(const Evidence& evidence) {
  if (!evidence.whole) return Verdict::refuted;
  if (std::hypot(1, evidence.noise) < evidence.error) return Verdict::refuted;
  const bool one_is_left = evidence.heaps > 1 && evidence.heaps - evidence.rejected == 1;
  return !one_is_left && std::hypot(evidence.error, evidence.noise) <= 1 ? Verdict::meets : Verdict::undecided;
}

Verdict verdict_on(const Evidence& evidence, double rejected_share) {
  const Verdict readings = verdict_on_readings(evidence);
  if (readings == Verdict::refuted || rejected_share >= 1) return readings;
  const double by_count = within_by_count(evidence, rejected_share);
  const double by_index = within_by_index(evidence, rejected_share).value_or(by_count);
  if (std::min(by_count, by_index) < hardly_within) return Verdict::refuted;
  return by_index >= surely_within && by_count >= likely_within ? readings : Verdict::undecided;
}

double shortfall(const Evidence& evidence, double rejected_share) {
  if (!evidence.whole) return std::numeric_limits<double>::infinity();
  if (evidence.rejected == 0 || rejected_share >= 1) return evidence.error;
  return std::max(evidence.error, static_cast<double>(evidence.rejected) / evidence.heaps / rejected_share);
}

double packings_to_decide(const Evidence& evidence) {
  constexpr double least = 1e-6;  // at the tolerance itself no number of packings suffices
  const double left = std::abs(1 - evidence.error * evidence.error);
  return evidence.heaps * evidence.noise * evidence.noise / std::max(left, least);
}

}  // namespace pastefit
