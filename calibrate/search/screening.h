#pragma once

#include <cstdint>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// Hash of a seed and a counter; the same on every machine. Source: the finaliser of SplitMix64 (Steele, Lea & Flood,
/// OOPSLA 2014).
std::uint64_t hash_of(std::uint64_t seed, std::uint64_t counter);

/// Space-filling points of the unit cube: a Sobol sequence without its first point (the corner 0), each coordinate
/// shifted by a number drawn from `seed` and wrapped (Cranley & Patterson 1976). Seed 0: no shift.
/// Requirements: dimension >= 1, count >= 0. Shapes: count points of `dimension` coordinates, each in [0, 1).
std::vector<UnitPoint> screening_points(int dimension, int count, std::uint64_t seed);

/// First phase: space-filling points, simulated on one packing all at once. If all of them fail, it continues the
/// sequence until half of the budget is spent. With coarse grains it takes no decision from the answers.
class ScreeningPhase : public SearchPhase {
 public:
  ScreeningPhase(StrategyState& state, Fidelity fidelity) : state_(state), fidelity_(fidelity) {}
  bool advance() override;

 private:
  StrategyState& state_;
  const Fidelity fidelity_;
  int known_ = -1;  // simulations at its start; negative: not started
  int asked_ = 0;
};

}  // namespace pastefit
