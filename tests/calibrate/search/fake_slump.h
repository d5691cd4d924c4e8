#pragma once

#include <algorithm>
#include <array>
#include <numbers>

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

/// Height and spread [mm] of a heap of the Abrams cone's volume, without noise: a second-order fit to 498 simulations
/// of concrete mix 66 with grains of 11 mm. Coordinates: strength (10 to 40,000 Pa, logarithmic), share left at rupture
/// (0 to 0.5), curvature (-0.5 to 1), gap (0.05 to 1, logarithmic), formation gap over rupture gap, friction (0.05 to
/// 0.8), rolling friction (0 to 0.6). `share` is the width over that of the cone of the same height and volume.
inline std::array<double, 2> mean_heap(const UnitPoint& x) {
  const Eigen::ArrayXd c = x.array() - 0.5;
  const double drive = -0.84 + c[0] * (3.9 + 8.4 * c[0] - 1.4 * c[2] + 2.5 * c[3]) - 0.5 * c[2] +
                       c[3] * (-0.6 + 1.1 * c[3] + 2.7 * c[4]) + c[4] * (-1.7 + 1.8 * c[4]) +
                       c[5] * (0.8 - 2.1 * c[5]) + 0.7 * c[6];
  const double height = 25 + 275 / (1 + std::exp(-drive));
  const double share = 0.85 + c[0] * (-0.31 - 0.12 * c[0] - 0.14 * c[3] - 0.15 * c[6]) + 0.04 * c[2] - 0.1 * c[3] +
                       c[4] * (-0.03 + 0.1 * c[5]) + c[5] * (-0.06 + 0.12 * c[5]);
  constexpr double volume_mm3 = 5.498e6;
  const double cone = 2 * std::sqrt(3 * volume_mm3 / (std::numbers::pi * height));
  return {height, std::max(200.0, share * cone)};
}

/// A fake slump with height and spread measured and fitted within 7.5 and 25 mm. Noise of one simulation: 6 mm where
/// the heap moves, 3 % of the spread; heaps that stand high are narrow (correlation -0.8).
inline Synthetic fake_heap(double height_mm, double spread_mm, std::uint64_t seed) {
  Synthetic objective;
  objective.dimension = 7;
  objective.measured = {height_mm, spread_mm};
  objective.standard_deviations = {7.5, 25};
  objective.tolerances = {7.5, 25};
  objective.observe = [seed](const UnitPoint& x, std::uint64_t packing) {
    const auto [height, spread] = mean_heap(x);
    const double calm = std::clamp((300 - height) / 40, 0.0, 1.0);
    const double high = normal(digest(x), hash_of(seed, packing)), wide = normal(digest(x), hash_of(seed + 1, packing));
    return std::vector<double>{std::min(300.0, height + 6 * calm * high),
                               spread + 0.03 * calm * spread * (-0.8 * high + 0.6 * wide)};
  };
  return objective;
}

/// The same, with the shift of the top fitted to 0 within 40 mm. It is never 0: 34 mm in the mean, everywhere.
inline Synthetic shifting_heap(double height_mm, double spread_mm, std::uint64_t seed) {
  Synthetic objective = fake_heap(height_mm, spread_mm, seed);
  objective.measured.push_back(0);
  objective.standard_deviations.push_back(20);
  objective.tolerances.push_back(40);
  const auto heap = objective.observe;
  objective.observe = [seed, heap](const UnitPoint& x, std::uint64_t packing) {
    std::vector<double> readings = heap(x, packing);
    readings.push_back(
        27 * std::hypot(normal(digest(x), hash_of(seed + 2, packing)), normal(digest(x), hash_of(seed + 3, packing))));
    return readings;
  };
  return objective;
}

/// A fake heap of a material that is brittle where its gap is wide (coordinate 3 above 0.5): a packing stands like the
/// mould or shears off to 100 mm, and only the mean of many packings is that of the other heaps. So does concrete mix
/// 79 above 5000 Pa: 134 mm with a deviation of 65 mm, where half the gap has 133 with 14.
inline Synthetic brittle_heap(double height_mm, double spread_mm, std::uint64_t seed) {
  Synthetic objective = fake_heap(height_mm, spread_mm, seed);
  const auto tough = objective.observe;
  objective.observe = [seed, tough](const UnitPoint& x, std::uint64_t packing) {
    constexpr double stands = 290, sheared = 100, spread_of_height = -0.66;
    const auto [height, spread] = mean_heap(x);
    if (x[3] < 0.5 || height < sheared || height > stands) return tough(x, packing);
    const bool holds = uniform(digest(x), hash_of(seed, packing)) < (height - sheared) / (stands - sheared);
    const double read = holds ? stands : sheared;
    return std::vector<double>{read, spread + spread_of_height * (read - height)};
  };
  return objective;
}

}  // namespace pastefit::synthetic
