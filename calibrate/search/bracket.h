#pragma once

#include <optional>

#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// Where one parameter is free, a response may jump: a heap stands or flows by a small change of a threshold, and a
/// smooth model of it says that what lies within the jump is out of reach. If no simulation has a reading beyond the
/// laboratory's, both ends of the range are simulated. Neighbours on either side of the laboratory that differ by many
/// tolerances are then halved until one of them meets it. Of several parameters nothing is asked.
class BracketPhase : public SearchPhase {
 public:
  explicit BracketPhase(StrategyState& state) : state_(state) {}
  bool advance() override;
  /// A point that was found by halving and meets the laboratory on its packing.
  const std::optional<UnitPoint>& found() const { return found_; }

 private:
  StrategyState& state_;
  bool begun_ = false;
  int halvings_ = 0;
  std::optional<UnitPoint> found_;
};

}  // namespace pastefit
