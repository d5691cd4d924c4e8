#pragma once

#include <algorithm>

#include "synthetic.h"

namespace pastefit::synthetic {

inline SearchOptions options_with(std::uint64_t seed) {
  SearchOptions options;
  options.seed = seed;
  return options;
}

/// Remaining height [mm] of a slump test, as a simulation has it: 300 where nothing moves, low where all flows, and in
/// between mostly a matter of the logarithm of the strength (coordinate 0, 200 to 60,000 Pa); the others matter little.
inline double mean_height(const UnitPoint& x) {
  const double drive = 9 * (x[0] - 0.45) + 0.5 * (x[1] - 0.5) - 0.3 * (x[2] - 0.5) + 0.4 * (x[3] - 0.5);
  return std::clamp(30 + 285 / (1 + std::exp(-drive)), 30.0, 300.0);
}

/// A fake slump with one measured height. Noise of one simulation: 4 mm, a part of it the packing's own and the
/// larger part different at every point, less where the heap does not move. The strongest and stickiest fail.
inline Synthetic fake_slump(double height_mm, std::uint64_t seed) {
  Synthetic objective;
  objective.dimension = 5;
  objective.measured = {height_mm};
  objective.standard_deviations = {5};
  objective.observe = [seed](const UnitPoint& x, std::uint64_t packing) {
    const double mean = mean_height(x);
    const double calm = std::clamp((300 - mean) / 20, 0.0, 1.0);
    const double noise = 2 * normal(seed, packing) + 3.5 * normal(digest(x), hash_of(seed, packing));
    return std::vector<double>{std::min(300.0, mean + calm * noise)};
  };
  objective.fails = [](const UnitPoint& x, std::uint64_t) { return x[0] > 0.85 && x[4] + x[3] > 0.9; };
  return objective;
}

/// The same with coarse grains: lower by 25 mm where the heap is half as high as the mould, on its own fillings, with
/// half as much noise again.
inline Synthetic coarse_fake_slump(double height_mm, std::uint64_t seed) {
  Synthetic objective = fake_slump(height_mm, seed);
  const auto fine = objective.observe;
  objective.observe = [fine](const UnitPoint& x, std::uint64_t packing) {
    const double mean = mean_height(x);
    const double bias = -25 * std::max(0.0, 1 - std::pow((mean - 165) / 135, 2));
    return std::vector<double>{std::min(300.0, mean + bias + 1.5 * (fine(x, packing)[0] - mean))};
  };
  return objective;
}

/// Adds the height after one drop and a reading of sag that is mostly noise.
inline Synthetic fake_two_step(double height_mm, double after_mm, double sag_mm, std::uint64_t seed) {
  Synthetic objective = fake_slump(height_mm, seed);
  objective.measured = {height_mm, after_mm, sag_mm};
  objective.standard_deviations = {5, 5, 5};
  const auto first = objective.observe;
  objective.observe = [first, seed](const UnitPoint& x, std::uint64_t packing) {
    const double height = first(x, packing)[0];
    const double kept = 0.55 + 0.35 * x[0] + 0.15 * (x[1] - 0.5);
    const std::uint64_t at = digest(x);
    return std::vector<double>{height, height * kept + 2 * normal(at, hash_of(seed + 1, packing)),
                               6 + 10 * x[2] + 4 * normal(at, hash_of(seed + 2, packing))};
  };
  return objective;
}

}  // namespace pastefit::synthetic
