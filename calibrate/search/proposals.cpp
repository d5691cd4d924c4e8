#include "calibrate/search/proposals.h"

#include <algorithm>

#include "calibrate/optimisers/problem.h"
#include "calibrate/search/surrogate.h"
#include "core/random.h"

namespace pastefit {
namespace {

constexpr int coarse_tries = 4;      // coarse simulations before each fine one
constexpr double worthwhile = 0.02;  // smallest expected improvement worth a simulation, over the allowed misfit

UnitPoint point_of_largest_margin(const CandidateRanking& ranking, const Surrogate& model) {
  constexpr double slope = 1e-4;  // leads out of regions without expected margin
  const auto lacking = [&](const UnitPoint& point) {
    return slope * model.misfit_posterior(point).mean() - ranking.expected_margin(model, point);
  };
  return least_point(lacking, ranking.best().size() > 0 ? ranking.best() : ranking.least());
}

}  // namespace

bool Proposals::look(const CandidateRanking& ranking) {
  if (!proposal_) {
    found_.reset();
    proposal_ = promising(ranking);
    coarse_tries_ = 0;
    if (!proposal_) return true;
  }
  if (!try_with_coarse_grains()) return false;
  found_ = distinct(*proposal_);
  proposal_.reset();
  return true;
}

std::optional<UnitPoint> Proposals::promising(const CandidateRanking& ranking) const {
  Surrogate model = ranking.surrogate();
  fantasise_answers(model);
  double least = ranking.least_misfit();
  for (const EvaluationHistory::Asked& asked : history_.under_way())
    least = std::min(least, model.misfit_posterior(asked.point).mean());
  Improvement best = maximise_expected_improvement(model, least, ranking.least());
  if (best.expected < worthwhile * history_.allowed_misfit()) {
    best.point = point_of_largest_margin(ranking, model);
    const double gain = ranking.expected_margin(model, best.point) - ranking.margin_of_best();
    if (gain < worthwhile_margin) return std::nullopt;
  }
  return best.point;
}

bool Proposals::try_with_coarse_grains() {
  if (coarse_known_) {
    const bool taught = history_.coarse_singles().size() > *coarse_known_;
    coarse_known_.reset();
    if (!taught) return true;
    Surrogate model(history_.training_data(), history_.allowances(), history_.scoring().rejected_share());
    fantasise_answers(model);
    const auto misfit = [&](const UnitPoint& point) { return model.misfit_posterior(point).mean(); };
    const UnitPoint better = least_point(misfit, *proposal_);
    if (misfit(*proposal_) <= misfit(better) + model.noise() / options_.packings) return true;
    if (++coarse_tries_ < coarse_tries) proposal_ = better;
  }
  if (!with_coarse_ || coarse_tries_ >= coarse_tries || history_.stop_requested()) return true;
  coarse_known_ = history_.coarse_singles().size();
  history_.evaluate_coarse({&*proposal_, 1}, packings_of_coarse(options_.seed, options_.packings));
  return false;
}

std::optional<UnitPoint> Proposals::distinct(const UnitPoint& proposal) const {
  const auto is_same = [&](const auto& asked) {
    return (asked.point - proposal).template lpNorm<Eigen::Infinity>() < same_point;
  };
  if (std::ranges::any_of(history_.under_way(), is_same)) return std::nullopt;
  const auto known = std::ranges::find_if(history_.singles(), is_same);
  return known == history_.singles().end() ? proposal : known->point;
}

/// Draws answers of the pending candidates.
void Proposals::fantasise_answers(Surrogate& model) const {
  const RandomStream random(options_.seed, "answers of candidates under way");
  std::uint64_t candidate = history_.responses().size();  // its future index in the history
  for (const EvaluationHistory::Asked& asked : history_.under_way()) {
    Eigen::VectorXd deviates(history_.residuals());
    for (Eigen::Index k = 0; k < deviates.size(); ++k) deviates[k] = random.normal(candidate * deviates.size() + k);
    model.fantasise(asked.point, deviates);
    ++candidate;
  }
}

}  // namespace pastefit
