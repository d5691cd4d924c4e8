#include "calibrate/search/candidate_ranking.h"

#include <algorithm>
#include <array>
#include <limits>

#include "calibrate/evaluate/response.h"

namespace pastefit {
namespace {

constexpr double far_from_prior = 2;  // standard deviations at which a candidate contradicts a prior

// These counts satisfy `verdict_on`.
constexpr int confirmed_heaps = 16, confirmed_rejected = 2;

constexpr double no_misfit = std::numeric_limits<double>::infinity();  // larger than any

}  // namespace

CandidateRanking::CandidateRanking(const EvaluationHistory& history, std::span<const UnitPoint> refuted)
    : history_(history),
      surrogate_(history.training_data(), history.allowances(), history.scoring().rejected_share()),
      misfit_of_best_(no_misfit),
      least_misfit_(no_misfit) {
  const auto is_refuted = [&](const UnitPoint& point) {
    return std::ranges::any_of(refuted, [&](const UnitPoint& one) { return one == point; });
  };
  for (const Response& seen : history.training_data()) {
    if (!is_feasible(seen)) continue;
    const double misfit = surrogate_.misfit_posterior(seen.point).mean();
    if (misfit >= least_misfit_) continue;
    least_misfit_ = misfit;
    least_ = seen.point;
  }
  double most_plausible = no_misfit;
  for (const Response& seen : history.singles()) {
    if (!is_whole(seen) || is_refuted(seen.point)) continue;
    const double misfit = surrogate_.misfit_posterior(seen.point).mean();
    if (misfit < most_plausible) {
      most_plausible = misfit;
      most_plausible_ = seen.point;
    }
    const double expected = expected_margin(seen.point), margin = expected < worthwhile_margin ? 0 : expected;
    if (margin < margin_of_best_ || (margin == margin_of_best_ && misfit >= misfit_of_best_)) continue;
    margin_of_best_ = margin;
    misfit_of_best_ = misfit;
    best_ = seen.point;
  }
}

/// Trapezoidal rule for the integral of the probability from 0 to 1 tolerance; it is 0 at 0.
double CandidateRanking::expected_margin(const Surrogate& model, const UnitPoint& point) const {
  constexpr std::array tolerances{0.25, 0.5, 0.75, 1.0};
  const std::vector<double> chances = chances_of(model, point, tolerances);
  double sum = chances.back() / 2;
  for (std::size_t k = 0; k + 1 < chances.size(); ++k) sum += chances[k];
  return sum / static_cast<double>(chances.size());
}

std::vector<double> CandidateRanking::chances_of(const Surrogate& model, const UnitPoint& point,
                                                 std::span<const double> tolerances) const {
  std::vector<double> chances = chances_of_readings(model, point, tolerances);
  if (history_.scoring().rejected_share() >= 1) return chances;
  const double accepted = model.accepted(point, confirmed_rejected, confirmed_heaps);
  for (double& chance : chances) chance *= accepted;
  return chances;
}

std::vector<double> CandidateRanking::chances_of_readings(const Surrogate& model, const UnitPoint& point,
                                                          std::span<const double> tolerances) const {
  std::vector<Eigen::VectorXd> bounds;
  for (const double share : tolerances) {
    bounds.emplace_back(Eigen::VectorXd::Constant(history_.residuals(), far_from_prior));
    bounds.back().head(history_.readings()) = share * history_.allowances().head(history_.readings());
  }
  return model.within(bounds, point);
}

}  // namespace pastefit
