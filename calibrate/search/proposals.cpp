#include "calibrate/search/proposals.h"

#include <algorithm>
#include <cmath>

#include "calibrate/optimisers/nlopt.h"
#include "calibrate/search/low_fidelity.h"
#include "core/random.h"

namespace pastefit {
namespace {

constexpr int coarse_tries = 4;      // proposals tried with coarse grains before one is with fine ones
constexpr double worthwhile = 0.02;  // improvement that is worth a simulation, of the misfit of a good candidate

UnitPoint point_of_largest_margin(const CandidateRanking& ranking, const Surrogate& model) {
  constexpr double slope = 1e-4;  // leads out of where no margin is in sight
  const auto lacking = [&](const UnitPoint& point) {
    return slope * model.misfit_posterior(point).mean() - ranking.expected_margin(model, point);
  };
  return least_point(lacking, ranking.best().size() > 0 ? ranking.best() : ranking.least());
}

}  // namespace

std::optional<UnitPoint> Proposals::next(const CandidateRanking& ranking) {
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
  const UnitPoint proposal = tried_with_coarse_grains(best.point);
  const auto is_same = [&](const auto& asked) {
    return (asked.point - proposal).template lpNorm<Eigen::Infinity>() < same_point;
  };
  if (std::ranges::any_of(history_.under_way(), is_same)) return std::nullopt;
  const auto known = std::ranges::find_if(history_.singles(), is_same);
  return known == history_.singles().end() ? proposal : known->point;
}

UnitPoint Proposals::tried_with_coarse_grains(UnitPoint proposal) {
  for (int tries = 0; with_coarse_ && tries < coarse_tries && !history_.stop_requested(); ++tries) {
    const std::size_t known = history_.coarse_singles().size();
    history_.evaluate_coarse({&proposal, 1}, packings_of_coarse(options_.seed, options_.packings));
    if (history_.coarse_singles().size() == known) break;
    Surrogate model(history_.training_data(), history_.allowances(), history_.scoring().rejected_share());
    fantasise_answers(model);
    const auto misfit = [&](const UnitPoint& point) { return model.misfit_posterior(point).mean(); };
    const UnitPoint better = least_point(misfit, proposal);
    if (misfit(proposal) <= misfit(better) + model.noise() / options_.packings) break;
    if (tries + 1 < coarse_tries) proposal = better;
  }
  return proposal;
}

/// Draws the answers of the candidates under way.
void Proposals::fantasise_answers(Surrogate& model) const {
  const RandomStream random(options_.seed, "answers of candidates under way");
  std::uint64_t candidate = history_.responses().size();  // its place in the history to come
  for (const EvaluationHistory::Asked& asked : history_.under_way()) {
    Eigen::VectorXd deviates(history_.residuals());
    for (Eigen::Index k = 0; k < deviates.size(); ++k)
      deviates[k] =
          random.normal(candidate * static_cast<std::uint64_t>(deviates.size()) + static_cast<std::uint64_t>(k));
    (void)model.fantasise(asked.point, static_cast<int>(asked.packings.size()), deviates);
    ++candidate;
  }
}

}  // namespace pastefit
