#pragma once

#include <span>

namespace pastefit {

/// What a series of equally spaced values is like once its start is forgotten.
struct SteadyState {
  std::size_t first = 0;      ///< value from which on it is steady
  double mean = 0;            ///< of the values from there on
  double standard_error = 0;  ///< of that mean, the correlation of neighbours counted
  bool reached = false;       ///< at least half of the series is steady
};

/// Where a series is steady, and its mean there.
///
/// The start is cut off where the mean of the rest is known best: at the k, in the first three quarters, at which
/// sum_{i >= k} (y_i - mean_k)^2/(n - k)^2 is smallest (marginal standard error rule, of batches of four values: White
/// 1997, Simulation 69:323; White, Cobb & Spratt 2000). A series that is cut beyond its half still changed: not
/// reached.
/// The error is that of block averages: standard deviation of the means of blocks over the root of their number, the
/// largest for blocks of 1, 2, 4 ... values, as long as there are eight blocks (Flyvbjerg & Petersen 1989, J. Chem.
/// Phys. 91:461). With so few blocks it is known to a quarter.
/// Requirement: at least 64 values, all finite.
SteadyState steady_state(std::span<const double> values);

}  // namespace pastefit
