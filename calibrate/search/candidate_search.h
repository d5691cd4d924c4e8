#pragma once

#include <cstdint>
#include <vector>

#include "calibrate/optimisers/ceres.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// The second and third phase: brings candidates, with the surrogate or with an optimiser, and descends from the best
/// one where the surrogate sees none that is better.
class CandidateSearch {
 public:
  CandidateSearch(StrategyState& state, bool with_coarse) : state_(state), with_coarse_(with_coarse) {}

  /// Brings candidates; false if not a single one could be had.
  bool look_for_candidate();
  /// Descends where the surrogate sees no better candidate and none that will do, unless what is left is luck.
  void refine();

 private:
  int share_of_budget() const;
  void minimise_misfit();
  void propose_and_try();
  double noise() const;
  double probe_length() const;
  void descend(TrustRegion trust_region, const UnitPoint& start, int evaluations);

  StrategyState& state_;
  bool with_coarse_;
};

}  // namespace pastefit
