#pragma once

#include <span>

namespace pastefit {

/// The steady part of a series of equally spaced values.
struct SteadyState {
  std::size_t first = 0;      ///< first steady value
  double mean = 0;            ///< of the steady values
  double standard_error = 0;  ///< of that mean, with correlation of neighbouring values
  bool reached = false;       ///< at least half of the series is steady
};

/// Finds the steady part of a series, and its mean.
///
/// The start is cut off at the k, in the first three quarters, at which sum_{i >= k} (y_i - mean_k)^2/(n - k)^2 is
/// smallest (marginal standard error rule, with batches of four values: White 1997, Simulation 69:323; White, Cobb &
/// Spratt 2000). A cut beyond the middle means that the series still changes: not reached.
///
/// The standard error comes from block averages: standard deviation of the block means over the root of their number,
/// the largest for blocks of 1, 2, 4 ... values with at least eight blocks (Flyvbjerg & Petersen 1989, J. Chem. Phys.
/// 91:461). With so few blocks its own error is a quarter.
///
/// Requirement: at least 64 values, all finite.
SteadyState steady_state(std::span<const double> values);

}  // namespace pastefit
