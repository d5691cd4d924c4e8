#pragma once

#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// The last phase: judges the likely best candidate on packings that the search has not used, and keeps the one to be
/// reported.
class ConfirmationPhase {
 public:
  explicit ConfirmationPhase(StrategyState& state) : state_(state) {}

  /// Asks the candidate on fresh packings, and on half as many more while their noise hides the answer; true if it
  /// holds. A quarter of them is asked first: if it is unlikely then that it will do, the others are saved, but for
  /// `whatever_it_does`. With `SearchOptions::max_pending`, when workers would be idle meanwhile, all are asked at
  /// once. `asked`: the candidate to be judged instead, e.g. one that no smooth model would choose.
  bool confirm(bool whatever_it_does, const UnitPoint& asked = {});
  /// The confirmation that is reported was broken off, or left undecided: the rest of its packings, and half as many
  /// more while their noise hides the answer, if the budget has them. They may prove wrong what broke it off.
  void finish();

  bool confirmed() const { return confirmed_; }
  int rounds() const { return rounds_; }
  const Response& best() const { return best_; }                  ///< on every packing; no point if none was judged
  const Response& search() const { return search_; }              ///< the same on those before it was judged
  const Response& confirmation() const { return confirmation_; }  ///< the same on the fresh ones

 private:
  int first_packings() const;
  std::size_t further_packings() const;
  /// Judges a candidate on these packings and further ones, and reports it; false if a stop was requested meanwhile.
  bool judge(const UnitPoint& candidate, std::vector<std::uint64_t> fresh, bool whatever_it_does);
  /// The result is this candidate, judged on fresh packings, if none was that came nearer to being confirmed
  /// (`shortfall`). Misfits would not do: they are weighed by noise that is known better later.
  void report(const Response& confirmation);

  StrategyState& state_;
  bool confirmed_ = false;
  int rounds_ = 0;
  Response best_, search_, confirmation_;
};

}  // namespace pastefit
