#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "calibrate/judge/verdict.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// Chooses the candidate to confirm among all that are likely to meet the readings: the point of least expected misfit,
/// priors included (the maximum a posteriori point; in Bayesian optimisation, the recommendation). Otherwise a search
/// would report whichever acceptable material it met first, which differs from seed to seed. Each of eight rounds, or
/// of three if the simulations have little noise or few are left, simulates that point on a fresh packing and asks the
/// surrogate again. Limit: the noise of the simulations shifts the point; their number bounds how well two seeds agree.
/// Requirement: the best candidate is likely to be confirmed (`StrategyState::goal_is_met`).
class RecommendationPhase : public SearchPhase {
 public:
  explicit RecommendationPhase(StrategyState& state) : state_(state) {}
  bool advance() override;
  /// The simulated point; none if it is less likely to be confirmed than a confirmation requires.
  const UnitPoint& found() const { return found_; }

 private:
  StrategyState& state_;
  int simulated_ = 0;
  UnitPoint found_;
};

/// Simulates the best candidate on packings that the search has not used, and keeps the result to report.
class ConfirmationPhase : public SearchPhase {
 public:
  explicit ConfirmationPhase(StrategyState& state) : state_(state) {}

  /// Starts a confirmation on fresh packings and adds half as many at a time while the verdict is undecided. It begins
  /// with a quarter of them and stops there if success is unlikely, unless `whatever_it_does`. With
  /// `SearchOptions::max_pending` all are simulated at once, because workers would be idle. `asked`: candidate to
  /// confirm; empty: the best of the ranking.
  void begin(bool whatever_it_does, const UnitPoint& asked = {});
  /// Completes the reported confirmation if it was broken off or is undecided: simulates its remaining packings, then
  /// half as many at a time while undecided and affordable. The result may reverse the decision to break off.
  void begin_last();
  bool advance() override;

  bool confirmed() const { return confirmed_; }
  const Response& best() const { return best_; }                  ///< on all packings; no point if none was confirmed
  const Response& search() const { return search_; }              ///< on packings before its confirmation
  const Response& confirmation() const { return confirmation_; }  ///< on the fresh packings

 private:
  /// Verdict on the fresh packings, and the number of further ones to simulate; 0: none.
  std::pair<Verdict, std::size_t> look_at(const Response& confirmation) const;
  void conclude(const Response& confirmation, Verdict verdict);
  /// Reports this candidate unless an earlier one has a smaller `shortfall`. Misfits are not compared, because their
  /// noise weights change during the search.
  void report(const Response& confirmation);

  StrategyState& state_;
  UnitPoint candidate_;               // under confirmation; empty: none
  std::vector<std::uint64_t> fresh_;  // its packings
  bool whatever_it_does_ = false;
  bool last_ = false;   // `begin_last` was called
  bool asked_ = false;  // `fresh_` was enqueued
  bool confirmed_ = false;
  Response best_, search_, confirmation_;
};

}  // namespace pastefit
