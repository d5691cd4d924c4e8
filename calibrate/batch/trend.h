#pragma once

#include <span>
#include <string_view>

namespace pastefit {

/// How a number is taken to depend on a variable.
enum class TrendModel { linear, gaussian_process };

/// The model as it is stored and printed, e.g. "gaussian_process".
std::string_view name_of(TrendModel model);

/// A number predicted at one value of the variable.
struct TrendPrediction {
  double mean = 0;
  double half_width = 0;  ///< of the 95 % interval for one more material there, its scatter about the trend included
};

/// Fits the numbers `y` seen at `x` and predicts at `at`. Linear: least squares, with Student's prediction interval
///     t(0.975; n - 2) s sqrt(1 + 1/n + (at - mean x)^2/sum (x - mean x)^2),   s^2 = sum of squares/(n - 2).
/// Gaussian process: `GaussianProcess` over the range of x, with 1.96 deviations of its mean and its noise together.
/// Requirements: as many y as x, three at least, and not all x the same.
TrendPrediction predict_trend(std::span<const double> x, std::span<const double> y, double at, TrendModel model);

}  // namespace pastefit
