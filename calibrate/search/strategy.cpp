#include "calibrate/search/strategy.h"

#include <algorithm>
#include <optional>

#include "calibrate/search/candidate_search.h"
#include "calibrate/search/coarse_rung.h"
#include "calibrate/search/conclusion.h"
#include "calibrate/search/confirmation_phase.h"
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
    Archive& archive = state_.archive;
    archive.hold_back(state_.options.confirmation_packings);
    if (with_coarse_) screen_coarsely(state_);
    if (archive.evidence().empty()) screen(state_);
    if (!archive.singles().empty() && is_out_of_reach()) {
      archive.evaluate({&out_of_reach_->nearest, 1}, state_.common);
      if (!archive.stop_requested() && state_.prospects().best().size() > 0) confirmation_.confirm(true);
      if (archive.stop_requested() || confirmation_.confirmed() || claim_stands()) return conclude();
    }
    searched_ = true;
    while (any_evidence() && state_.may_go_on()) {
      if (!candidates_.look_for_candidate()) break;
      candidates_.refine();
      if (archive.stop_requested() || confirmation_.confirm(false)) break;
    }
    return conclude();
  }

 private:
  bool any_evidence() const {
    return std::ranges::any_of(state_.archive.evidence(), [](const Response& one) { return is_feasible(one); });
  }

  /// Says what the screening tells of the reach, and whether a search would be in vain.
  bool is_out_of_reach() {
    if (!state_.archive.any_feasible() || state_.archive.stop_requested()) return false;
    const int spare = state_.archive.budget_left() - static_cast<int>(state_.common.size());
    out_of_reach_ =
        find_out_of_reach(state_.archive, {state_.common.front(), std::min(state_.options.screening, spare)});
    if (state_.archive.stop_requested()) return false;
    state_.archive.say(out_of_reach_ ? words_of(*out_of_reach_, readings_, parameters_)
                                     : words_of_screening(state_.archive.singles(), readings_));
    return out_of_reach_.has_value();
  }

  /// Asks again what was said to be out of reach, by all that was simulated since; withdraws it if it is not.
  bool claim_stands() {
    const auto against = [&](const Response& one) { return contradicts(one, *out_of_reach_); };
    const auto contradiction = std::ranges::find_if(state_.archive.singles(), against);
    if (contradiction == state_.archive.singles().end()) {
      if (const auto again = known_out_of_reach(state_.archive, ReachOf::simulations);
          again && again->reading == out_of_reach_->reading) {
        out_of_reach_ = again;
        return true;
      }
    }
    state_.archive.say(words_of_withdrawal(*out_of_reach_, readings_));
    out_of_reach_.reset();
    return false;
  }

  /// What the model did with each reading, coarse simulations corrected.
  std::vector<Reach> reach() const {
    std::vector<double> allowances;
    for (std::size_t k = 0; std::ssize(allowances) < state_.scoring().readings(); ++k)
      allowances.push_back(state_.scoring().allowance(k));
    std::vector<Reach> out = reach_of(state_.archive.singles(), allowances);
    for (const Response& coarse : corrected(state_.archive.coarse_singles(), state_.archive.singles())) {
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
    if (result_.best.point.size() == 0 && state_.archive.any_feasible()) {
      result_.search = state_.archive.best_on(state_.common).value_or(Response{});
      if (result_.search.point.size() == 0)
        for (const Response& seen : state_.archive.history())
          if (is_whole(seen) && is_better(seen, result_.search)) result_.search = seen;
      if (result_.search.point.size() == 0) result_.search = state_.archive.best_single().value_or(Response{});
      result_.best = result_.search;
    }
    result_.history = state_.archive.history();
    result_.simulations = state_.archive.simulations();
    result_.coarse_simulations = static_cast<int>(state_.archive.coarse_singles().size());
    result_.failures = state_.archive.failures();
    result_.reach = reach();
    Ending ending{confirmation_.confirmed(), state_.archive.stop_requested(), state_.archive.any_feasible(),
                  with_coarse_, searched_};
    if (!confirmation_.confirmed() && !ending.stopped)
      ending.out_of_reach = searched_ ? known_out_of_reach(state_.archive, ReachOf::means) : out_of_reach_;
    ending.some_ended_early = std::ranges::any_of(state_.archive.singles(), &Response::ended_early);
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
