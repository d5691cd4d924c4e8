#include "calibrate/search/candidate_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

namespace {

/// Aborts an optimiser at an unknown answer.
struct NotKnown {};

}  // namespace

bool SimulatedMinimisation::advance() {
  EvaluationHistory& history = state_.history;
  if (std::exchange(asked_, false)) answers_.push_back(answers_of(history.answers()));
  std::size_t question = 0, allowed = 0;
  Problem problem;
  problem.parameters = history.parameters();
  problem.residuals = history.residuals();
  problem.may_evaluate = [&](int points) {
    if (asked_) return false;
    if (allowed == allowed_.size())
      allowed_.push_back(!history.stop_requested() && state_.affordable(points * state_.common.size()));
    return static_cast<bool>(allowed_[allowed++]);
  };
  problem.answer = [&](std::span<const UnitPoint> points) {
    if (question < answers_.size()) return answers_[question++];
    if (!std::exchange(asked_, true)) history.evaluate(points, state_.common);
    throw NotKnown{};
  };
  try {
    minimise_(problem);
  } catch (const NotKnown&) {
  }
  return !asked_;
}

std::vector<Answer> SimulatedMinimisation::answers_of(std::span<const Response> responses) const {
  std::vector<Answer> answers;
  for (const Response& response : responses)
    answers.push_back({response.point, response.misfit, response.residuals, !is_feasible(response),
                       goal_ > 0 && response.error <= goal_});
  return answers;
}

namespace {

/// Half of the remaining budget, in points on all common packings.
int share_of_budget(const StrategyState& state) {
  return std::max(1, state.history.budget_left() / static_cast<int>(2 * state.common.size()));
}

/// Misfit due to the noise of the common packings; 0 if unknown.
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

/// Probe length for Ceres, large enough against the noise. A residual that passes once through its range and saturates
/// at both ends has a curvature of about four times the range.
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
  const CeresOptions ceres{.trust_region = trust_region,
                           .difference_step = probe_length(state),
                           .step_tolerance = same_point,
                           .evaluations = evaluations,
                           .noise = noise_of(state)};
  return std::make_unique<SimulatedMinimisation>(
      state, state.optimisers_goal(), [=](const Problem& problem) { (void)minimise(problem, start, ceres); });
}

std::unique_ptr<SearchPhase> minimisation_of_misfit(StrategyState& state) {
  const NloptOptions nlopt{.algorithm = state.options.strategy,
                           .evaluations = share_of_budget(state),
                           .step_tolerance = same_point,
                           .seed = state.options.seed};
  const UnitPoint start = state.history.best_point(state.common);
  return std::make_unique<SimulatedMinimisation>(
      state, state.optimisers_goal(), [=](const Problem& problem) { (void)minimise(problem, start, nlopt); });
}

}  // namespace

bool ProposalPhase::advance() {
  EvaluationHistory& history = state_.history;
  if (awaits_ == Awaits::candidate) {
    const Response& response = history.answers().front();
    // Its misfit is a lower bound that does not rule the candidate out: the remaining readings decide.
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

/// Starts candidates up to the pending limit; false if a proposal waits for coarse simulations.
bool ProposalPhase::propose() {
  const bool enough = StrategyState::goal_is_met(*known_);
  while (!enough && state_.may_go_on() && std::ssize(state_.history.under_way()) <= state_.options.max_pending) {
    if (!proposals_.look(*known_)) return false;
    if (!proposals_.found()) break;
    state_.history.begin(*proposals_.found(), state_.fresh_packings(1).front());
  }
  return true;
}

std::unique_ptr<SearchPhase> candidate_phase(StrategyState& state, bool with_coarse) {
  state.history.enter("search");
  switch (*kind_of_strategy(state.options.strategy)) {
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

/// Rejected heaps do not start a refinement, because a descent on the readings cannot reduce rejections.
std::unique_ptr<SearchPhase> refinement_phase(StrategyState& state) {
  if (!state.may_go_on() || noise_of(state) > state.history.allowed_misfit()) return nullptr;
  const CandidateRanking known = state.ranking();
  if (StrategyState::readings_will_do(known)) return nullptr;
  state.history.enter("refinement");
  return descent(state, TrustRegion::levenberg_marquardt, known.best(), CeresOptions{}.evaluations);
}

namespace {

constexpr double kJump = 10;      // [allowances] between neighbours; smooth responses differ by less
constexpr double kFinest = 1e-5;  // of the range; nearer neighbours are one candidate
constexpr int kMostHalvings = 16;

/// Feasible simulations, sorted by the parameter.
std::vector<Response> in_order(const EvaluationHistory& history) {
  std::vector<Response> out;
  for (const Response& one : history.singles())
    if (is_feasible(one)) out.push_back(one);
  std::ranges::stable_sort(out, {}, [](const Response& one) { return one.point[0]; });
  return out;
}

/// Residual in allowances; 0 if not fitted or without reading.
double miss(const EvaluationHistory& history, const Response& one, std::size_t reading) {
  const double allowance = history.allowance(reading);
  return allowance > 0 && has_reading(one, reading) ? one.residuals[reading] / allowance : 0;
}

bool all_on_one_side(const EvaluationHistory& history, std::span<const Response> seen) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(history.readings()); ++k) {
    const auto above = [&](const Response& one) { return miss(history, one, k) > 1; };
    const auto below = [&](const Response& one) { return miss(history, one, k) < -1; };
    if (!seen.empty() && (std::ranges::all_of(seen, above) || std::ranges::all_of(seen, below))) return true;
  }
  return false;
}

/// Midpoint of the neighbours that differ most across the measurement; none if they differ by at most `jump`
/// allowances.
std::optional<UnitPoint> middle_of_jump(const EvaluationHistory& history, std::span<const Response> seen, double jump) {
  std::optional<UnitPoint> middle;
  double largest = jump;
  for (std::size_t i = 1; i < seen.size(); ++i) {
    const Response &one = seen[i - 1], &other = seen[i];
    if (other.point[0] - one.point[0] < kFinest) continue;
    for (std::size_t k = 0; k < static_cast<std::size_t>(history.readings()); ++k) {
      const double before = miss(history, one, k), after = miss(history, other, k);
      const bool across = before * after < 0 && std::min(std::abs(before), std::abs(after)) > 1;
      if (!across || std::abs(before - after) <= largest) continue;
      largest = std::abs(before - after);
      middle = 0.5 * (one.point + other.point);
    }
  }
  return middle;
}

bool is_met(const Response& one) {
  return is_whole(one) && one.error <= 1;
}

}  // namespace

bool BracketPhase::advance() {
  EvaluationHistory& history = state_.history;
  const std::span<const std::uint64_t> first(state_.common.data(), 1);
  if (history.parameters() != 1 || history.stop_requested() || !history.any_feasible()) return true;
  const std::vector<Response> seen = in_order(history);
  if (!std::exchange(begun_, true) && all_on_one_side(history, seen) && history.budget_left() >= 2) {
    const std::vector<UnitPoint> ends{UnitPoint::Constant(1, 0), UnitPoint::Constant(1, 1)};
    history.try_out(ends, first);
    return false;
  }
  if (halvings_ == kMostHalvings || history.budget_left() < 1) return true;
  if (const auto met = std::ranges::find_if(seen, is_met); met != seen.end()) {
    if (halvings_ > 0) found_ = met->point;
    return true;
  }
  const std::optional<UnitPoint> middle = middle_of_jump(history, seen, halvings_ == 0 ? kJump : 0);
  if (!middle) return true;
  ++halvings_;
  history.try_out({&*middle, 1}, first);
  return false;
}

}  // namespace pastefit
