#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "calibrate/judge/verdict.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// The last phase: judges the likely best candidate on packings that the search has not used, and keeps the one to be
/// reported.
class ConfirmationPhase : public SearchPhase {
 public:
  explicit ConfirmationPhase(StrategyState& state) : state_(state) {}

  /// Begins to ask the candidate on fresh packings, and on half as many more while their noise hides the answer. A
  /// quarter of them is asked first: if it is unlikely then that it will do, the others are saved, but for
  /// `whatever_it_does`. With `SearchOptions::max_pending`, when workers would be idle meanwhile, all are asked at
  /// once. `asked`: the candidate to be judged instead, e.g. one that no smooth model would choose.
  void begin(bool whatever_it_does, const UnitPoint& asked = {});
  /// Begins the end: if the confirmation that is reported was broken off, or left undecided, the rest of its packings
  /// are asked, and half as many more while their noise hides the answer, if the budget has them. They may prove wrong
  /// what broke it off.
  void begin_last();
  bool advance() override;

  bool confirmed() const { return confirmed_; }
  int rounds() const { return rounds_; }
  const Response& best() const { return best_; }                  ///< on every packing; no point if none was judged
  const Response& search() const { return search_; }              ///< the same on those before it was judged
  const Response& confirmation() const { return confirmation_; }  ///< the same on the fresh ones

 private:
  int first_packings() const;
  std::size_t further_packings() const;
  /// What the answers on the fresh packings say, and how many more are worth asking for; 0: none.
  std::pair<Verdict, std::size_t> look_at(const Response& confirmation) const;
  void conclude(const Response& confirmation, Verdict verdict);
  /// The result is this candidate, judged on fresh packings, if none was that came nearer to being confirmed
  /// (`shortfall`). Misfits would not do: they are weighed by noise that is known better later.
  void report(const Response& confirmation);

  StrategyState& state_;
  UnitPoint candidate_;               // that is judged; none: nothing is
  std::vector<std::uint64_t> fresh_;  // packings that it is judged on
  bool whatever_it_does_ = false;
  bool last_ = false;   // the end was begun
  bool asked_ = false;  // for these packings
  bool confirmed_ = false;
  int rounds_ = 0;
  Response best_, search_, confirmation_;
};

}  // namespace pastefit
