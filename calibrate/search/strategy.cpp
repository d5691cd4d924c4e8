#include "calibrate/search/strategy.h"

#include <algorithm>
#include <optional>

#include "calibrate/search/bracket.h"
#include "calibrate/search/candidate_search.h"
#include "calibrate/search/conclusion.h"
#include "calibrate/search/confirmation_phase.h"
#include "calibrate/search/low_fidelity.h"
#include "calibrate/search/reachability.h"
#include "calibrate/search/screening.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {
namespace {

/// The order of the phases, and what comes out.
class Strategy {
 public:
  Strategy(CandidateQueue& queue, const SearchOptions& options, const SearchStart& start,
           const std::function<void(const Progress&)>& progress)
      : with_coarse_(start.with_coarse && find_strategy(options.strategy)->kind == StrategyKind::surrogate),
        state_(queue, options, start, progress),
        candidates_(state_, with_coarse_),
        confirmation_(state_),
        readings_(start.readings),
        parameters_(start.parameters) {}

  Calibration run() {
    EvaluationHistory& history = state_.history;
    history.hold_back(state_.options.confirmation_packings);
    if (with_coarse_) screen_coarsely(state_);
    if (history.training_data().empty()) screen(state_);
    if (!with_coarse_ && find_strategy(state_.options.strategy)->kind == StrategyKind::surrogate)
      if (const auto found = bracket(state_); found && confirmation_.confirm(true, *found)) return conclude();
    if (!history.singles().empty() && is_out_of_reach()) {
      history.evaluate({&out_of_reach_->nearest, 1}, state_.common);
      if (!history.stop_requested() && state_.ranking().best().size() > 0) confirmation_.confirm(true);
      if (history.stop_requested() || confirmation_.confirmed() || claim_stands()) return conclude();
    }
    searched_ = true;
    while (any_evidence() && state_.may_go_on()) {
      if (!candidates_.look_for_candidate()) break;
      candidates_.refine();
      if (history.stop_requested() || confirmation_.confirm(false)) break;
    }
    return conclude();
  }

 private:
  bool any_evidence() const {
    return std::ranges::any_of(state_.history.training_data(), [](const Response& one) { return is_feasible(one); });
  }

  /// Says what the screening tells of the reach, and whether a search would be in vain.
  bool is_out_of_reach() {
    if (!state_.history.any_feasible() || state_.history.stop_requested()) return false;
    const int spare = state_.history.budget_left() - static_cast<int>(state_.common.size());
    out_of_reach_ =
        find_out_of_reach(state_.history, {state_.common.front(), std::min(state_.options.screening, spare)});
    if (state_.history.stop_requested()) return false;
    state_.history.say(out_of_reach_ ? describe(*out_of_reach_, readings_, parameters_)
                                     : describe_screening(state_.history.singles(), readings_));
    return out_of_reach_.has_value();
  }

  /// Asks again what was said to be out of reach, by all that was simulated since; withdraws it if it is not.
  bool claim_stands() {
    const auto against = [&](const Response& one) { return contradicts(one, *out_of_reach_); };
    const auto contradiction = std::ranges::find_if(state_.history.singles(), against);
    if (contradiction == state_.history.singles().end()) {
      if (const auto again = known_out_of_reach(state_.history, ReachOf::simulations);
          again && again->reading == out_of_reach_->reading) {
        out_of_reach_ = again;
        return true;
      }
    }
    state_.history.say(describe_withdrawal(*out_of_reach_, readings_));
    out_of_reach_.reset();
    return false;
  }

  /// What the model did with each reading, coarse simulations corrected.
  std::vector<Reach> reach() const {
    std::vector<double> allowances;
    for (std::size_t k = 0; std::ssize(allowances) < state_.scoring().readings(); ++k)
      allowances.push_back(state_.scoring().allowance(k));
    std::vector<Reach> out = reach_of(state_.history.singles(), allowances);
    for (const Response& coarse : corrected(state_.history.coarse_singles(), state_.history.singles())) {
      for (std::size_t k = 0; k < out.size(); ++k) {
        Reach& one = out[k];
        const double residual = coarse.residuals[static_cast<Eigen::Index>(k)];
        one.all_above = one.all_above && residual > allowances[k];
        one.all_below = one.all_below && residual < -allowances[k];
      }
    }
    return out;
  }

  Calibration conclude() {
    confirmation_.finish();
    result_.best = confirmation_.best();
    result_.search = confirmation_.search();
    result_.confirmation = confirmation_.confirmation();
    result_.rounds = confirmation_.rounds();
    if (result_.best.point.size() == 0 && state_.history.any_feasible()) {
      result_.search = state_.history.best_on(state_.common).value_or(Response{});
      if (result_.search.point.size() == 0)
        for (const Response& seen : state_.history.responses())
          if (is_whole(seen) && is_better(seen, result_.search)) result_.search = seen;
      if (result_.search.point.size() == 0) result_.search = state_.history.best_single().value_or(Response{});
      result_.best = result_.search;
    }
    result_.history = state_.history.responses();
    result_.simulations = state_.history.simulations();
    result_.coarse_simulations = static_cast<int>(state_.history.coarse_singles().size());
    result_.failures = state_.history.failures();
    result_.reach = reach();
    Ending ending{confirmation_.confirmed(), state_.history.stop_requested(), state_.history.any_feasible(),
                  with_coarse_, searched_};
    if (!confirmation_.confirmed() && !ending.stopped)
      ending.out_of_reach = searched_ ? known_out_of_reach(state_.history, ReachOf::means) : out_of_reach_;
    ending.some_censored = std::ranges::any_of(state_.history.singles(), &Response::censored);
    ending.rejected_share = state_.scoring().rejected_share();
    explain(result_, ending, state_.scoring().misfit_unit(), readings_, parameters_);
    return std::move(result_);
  }

  bool with_coarse_;
  StrategyState state_;
  CandidateSearch candidates_;
  ConfirmationPhase confirmation_;
  std::span<const std::string> readings_, parameters_;
  std::optional<OutOfReach> out_of_reach_;
  bool searched_ = false;  // a search was begun
  Calibration result_;
};

}  // namespace

Calibration run_strategy(CandidateQueue& queue, const SearchOptions& options, const SearchStart& start,
                         const std::function<void(const Progress&)>& progress) {
  return Strategy(queue, options, start, progress).run();
}

}  // namespace pastefit
