#include "calibrate/search/confirmation.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <cmath>

#include "calibrate/search/response.h"

namespace pastefit {
namespace {

// Probabilities that the share of rejected heaps is no larger than it may be.
constexpr double hardly_within = 0.1, surely_within = 0.8;

}  // namespace

Verdict verdict_on(const Response& response, double rejected_share) {
  if (!is_whole(response)) return Verdict::refuted;
  // Of a single heap that is left of many the scatter is not known.
  const bool known = accepted(response.evaluations).size() > 1 || response.evaluations.size() == 1;
  const Verdict of_readings = verdict_on(response.normalised_error, response.noise);
  const Verdict readings = known || of_readings == Verdict::refuted ? of_readings : Verdict::undecided;
  if (readings == Verdict::refuted || rejected_share >= 1) return readings;
  const double rejected = response.rejected, heaps = static_cast<double>(response.evaluations.size());
  const boost::math::beta_distribution<> share(rejected + 1, heaps - rejected + 1);
  const double within = boost::math::cdf(share, rejected_share);
  if (within < hardly_within) return Verdict::refuted;
  return within < surely_within ? Verdict::undecided : readings;
}

Verdict verdict_on(double normalised_error, double noise) {
  if (std::hypot(1, noise) < normalised_error) return Verdict::refuted;
  return std::hypot(normalised_error, noise) <= 1 ? Verdict::holds : Verdict::undecided;
}

double packings_to_decide(const Response& response) {
  constexpr double least = 1e-6;  // where no number of packings would tell
  const double left = std::abs(1 - response.normalised_error * response.normalised_error);
  return static_cast<double>(response.packings.size()) * response.noise * response.noise / std::max(left, least);
}

}  // namespace pastefit
