#include "calibrate/search/candidate_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calibrate/optimisers/nlopt.h"
#include "calibrate/search/proposals.h"
#include "calibrate/search/simulated_problem.h"

namespace pastefit {

bool CandidateSearch::look_for_candidate() {
  state_.history.enter("search");
  switch (find_strategy(state_.options.strategy)->kind) {
    case StrategyKind::surrogate:
      propose_and_try();
      break;
    case StrategyKind::ceres:
      descend(*trust_region_of(state_.options.strategy), state_.history.best_point(state_.common), share_of_budget());
      break;
    case StrategyKind::nlopt:
      minimise_misfit();
      break;
  }
  return state_.ranking().best().size() > 0;
}

/// Half of what is left, in points on all common packings.
int CandidateSearch::share_of_budget() const {
  return std::max(1, state_.history.budget_left() / static_cast<int>(2 * state_.common.size()));
}

void CandidateSearch::minimise_misfit() {
  NloptOptions nlopt;
  nlopt.algorithm = state_.options.strategy;
  nlopt.evaluations = share_of_budget();
  nlopt.step_tolerance = same_point;
  nlopt.seed = state_.options.seed;
  (void)minimise(simulated_problem(state_.history, state_.common, state_.optimisers_goal()),
                 state_.history.best_point(state_.common), nlopt);
}

/// Proposes, and takes the answers in the order of the proposals, until a candidate is likely to do. Proposal k knows
/// the answers up to k - 1 - max_pending, of the others only that they were asked: what is ready first does not matter.
void CandidateSearch::propose_and_try() {
  Proposals proposals(state_.history, with_coarse_, state_.options);
  while (true) {
    const CandidateRanking known = state_.ranking();
    const bool enough = StrategyState::goal_is_met(known);
    while (!enough && state_.may_go_on() && std::ssize(state_.history.under_way()) <= state_.options.max_pending) {
      const std::optional<UnitPoint> proposal = proposals.next(known);
      if (!proposal) break;
      state_.history.begin(*proposal, state_.fresh_packings(1));
    }
    if (state_.history.under_way().empty()) return;
    const Response response = state_.history.next_answer();
    // What it misses at least does not rule it out: its other readings decide.
    if (is_feasible(response) && response.censored && response.misfit < known.misfit_of_best() && state_.may_go_on())
      (void)state_.history.evaluate({&response.point, 1}, response.packings);
  }
}

/// Misfit that the noise of the packings makes by itself on the common set, as far as it is known.
double CandidateSearch::noise() const {
  double squares = 0;
  int freedom = 0;
  const auto& singles = state_.history.singles();
  for (std::size_t i = 0; i < singles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_whole(singles[i]) || !is_whole(singles[j]) || singles[i].point != singles[j].point) continue;
      squares += (singles[i].residuals - singles[j].residuals).squaredNorm() / 2;
      ++freedom;
    }
  }
  return freedom > 0 ? 0.5 * squares / freedom / static_cast<double>(state_.common.size()) : 0;
}

/// Probe for Ceres: long enough to show against the noise. A residual that goes through its range once, saturated at
/// both ends, has a curvature of about four times the range.
double CandidateSearch::probe_length() const {
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::ArrayXd least = Eigen::ArrayXd::Constant(state_.scoring().residuals(), infinity), most = -least;
  for (const Response& single : state_.history.training_data()) {
    if (!is_feasible(single)) continue;
    least = least.min(single.residuals.array());
    most = most.max(single.residuals.array());
  }
  const double deviation = std::sqrt(2 * noise() / state_.scoring().residuals());
  return noise_step(deviation, 4 * (most - least).maxCoeff());
}

/// Where only heaps that shear off speak against a candidate a descent on the readings is no help.
void CandidateSearch::refine() {
  if (!state_.may_go_on() || noise() > state_.history.allowed_misfit()) return;
  const CandidateRanking known = state_.ranking();
  if (StrategyState::readings_will_do(known)) return;
  state_.history.enter("refinement");
  descend(TrustRegion::levenberg_marquardt, known.best(), CeresOptions{}.evaluations);
}

void CandidateSearch::descend(TrustRegion trust_region, const UnitPoint& start, int evaluations) {
  CeresOptions ceres;
  ceres.trust_region = trust_region;
  ceres.evaluations = evaluations;
  ceres.difference_step = probe_length();
  ceres.step_tolerance = same_point;
  ceres.noise = noise();
  (void)minimise(simulated_problem(state_.history, state_.common, state_.optimisers_goal()), start, ceres);
}

}  // namespace pastefit
