#include "calibrate/search/candidate_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calibrate/optimisers/nlopt.h"
#include "calibrate/search/simulated_minimisation.h"

namespace pastefit {
namespace {

/// Half of what is left, in points on all common packings.
int share_of_budget(const StrategyState& state) {
  return std::max(1, state.history.budget_left() / static_cast<int>(2 * state.common.size()));
}

/// Misfit that the noise of the packings makes by itself on the common set, as far as it is known.
double noise_of(const StrategyState& state) {
  double squares = 0;
  int freedom = 0;
  const auto& singles = state.history.singles();
  for (std::size_t i = 0; i < singles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_whole(singles[i]) || !is_whole(singles[j]) || singles[i].point != singles[j].point) continue;
      squares += (singles[i].residuals - singles[j].residuals).squaredNorm() / 2;
      ++freedom;
    }
  }
  return freedom > 0 ? 0.5 * squares / freedom / static_cast<double>(state.common.size()) : 0;
}

/// Probe for Ceres: long enough to show against the noise. A residual that goes through its range once, saturated at
/// both ends, has a curvature of about four times the range.
double probe_length(const StrategyState& state) {
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::ArrayXd least = Eigen::ArrayXd::Constant(state.scoring().residuals(), infinity), most = -least;
  for (const Response& single : state.history.training_data()) {
    if (!is_feasible(single)) continue;
    least = least.min(single.residuals.array());
    most = most.max(single.residuals.array());
  }
  const double deviation = std::sqrt(2 * noise_of(state) / state.scoring().residuals());
  return noise_step(deviation, 4 * (most - least).maxCoeff());
}

std::unique_ptr<SearchPhase> descent(StrategyState& state, TrustRegion trust_region, const UnitPoint& start,
                                     int evaluations) {
  CeresOptions ceres;
  ceres.trust_region = trust_region;
  ceres.evaluations = evaluations;
  ceres.difference_step = probe_length(state);
  ceres.step_tolerance = same_point;
  ceres.noise = noise_of(state);
  return std::make_unique<SimulatedMinimisation>(
      state, state.optimisers_goal(), [=](const Problem& problem) { (void)minimise(problem, start, ceres); });
}

std::unique_ptr<SearchPhase> minimisation_of_misfit(StrategyState& state) {
  NloptOptions nlopt;
  nlopt.algorithm = state.options.strategy;
  nlopt.evaluations = share_of_budget(state);
  nlopt.step_tolerance = same_point;
  nlopt.seed = state.options.seed;
  return std::make_unique<SimulatedMinimisation>(
      state, state.optimisers_goal(), [nlopt, start = state.history.best_point(state.common)](const Problem& problem) {
        (void)minimise(problem, start, nlopt);
      });
}

}  // namespace

bool ProposalPhase::advance() {
  EvaluationHistory& history = state_.history;
  if (awaits_ == Awaits::candidate) {
    const Response& response = history.answers().front();
    // What it misses at least does not rule it out: its other readings decide.
    if (is_feasible(response) && response.censored && response.misfit < known_->misfit_of_best() &&
        state_.may_go_on()) {
      awaits_ = Awaits::whole;
      history.evaluate({&response.point, 1}, response.packings);
      return false;
    }
  }
  if (awaits_ != Awaits::coarse) known_.emplace(state_.ranking());
  awaits_ = Awaits::nothing;
  if (!propose()) {
    awaits_ = Awaits::coarse;
    return false;
  }
  if (history.under_way().empty()) return true;
  awaits_ = Awaits::candidate;
  history.await_next();
  return false;
}

/// Begins as many candidates as may be under way; false if a proposal waits for coarse simulations.
bool ProposalPhase::propose() {
  const bool enough = StrategyState::goal_is_met(*known_);
  while (!enough && state_.may_go_on() && std::ssize(state_.history.under_way()) <= state_.options.max_pending) {
    if (!proposals_.look(*known_)) return false;
    if (!proposals_.found()) break;
    state_.history.begin(*proposals_.found(), state_.fresh_packings(1));
  }
  return true;
}

std::unique_ptr<SearchPhase> candidate_phase(StrategyState& state, bool with_coarse) {
  state.history.enter("search");
  switch (find_strategy(state.options.strategy)->kind) {
    case StrategyKind::surrogate:
      return std::make_unique<ProposalPhase>(state, with_coarse);
    case StrategyKind::ceres:
      return descent(state, *trust_region_of(state.options.strategy), state.history.best_point(state.common),
                     share_of_budget(state));
    case StrategyKind::nlopt:
      return minimisation_of_misfit(state);
  }
  return nullptr;
}

/// Where only heaps that shear off speak against a candidate a descent on the readings is no help.
std::unique_ptr<SearchPhase> refinement_phase(StrategyState& state) {
  if (!state.may_go_on() || noise_of(state) > state.history.allowed_misfit()) return nullptr;
  const CandidateRanking known = state.ranking();
  if (StrategyState::readings_will_do(known)) return nullptr;
  state.history.enter("refinement");
  return descent(state, TrustRegion::levenberg_marquardt, known.best(), CeresOptions{}.evaluations);
}

}  // namespace pastefit
