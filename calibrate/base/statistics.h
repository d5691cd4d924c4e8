#pragma once

#include <span>
#include <vector>

namespace pastefit {

/// Count, mean and standard deviation of some readings.
struct Sample {
  int count = 0;
  double mean = 0;
  double standard_deviation = 0;  ///< of a single reading; 0 if there is only one
};

/// The deviation of equal readings is exactly 0.
Sample sample_of(std::span<const double> values);

/// Largest distance of the means of two samples of one population, exceeded with probability `false_alarm`:
///     t(1 - false_alarm/2; n + m - 2) s sqrt(1/n + 1/m),   s^2 = ((n-1) s_1^2 + (m-1) s_2^2)/(n + m - 2),
/// the two-sided t-interval for a difference of means with pooled variance (Student). Readings of the same packing are
/// positively correlated, if at all, which reduces false alarms. 0: neither sample has any scatter beyond rounding.
/// Requirement: n + m >= 3, n, m >= 1.
double band_of(const Sample& first, const Sample& second, double false_alarm);

/// As `band_of`, for samples with unequal variances (Welch), here simulation and measurement. The deviation of a sample
/// of one reading is taken as known.
double unequal_band_of(const Sample& first, const Sample& second, double false_alarm);

/// True if two means differ by at most their band or, if that is 0, by rounding: 1e-9 of their size.
bool lie_within(double band, double first, double second);

/// Largest value from `low` to `high` for which `is_below` holds, which it does up to that value, to 60 binary digits
/// of their difference.
double bisected(double low, double high, const auto& is_below) {
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (is_below(middle) ? low : high) = middle;
  }
  return low;
}

struct WeighedSquare {
  double square = 0, weight = 1;
};

/// Variance of normal variables of mean 0 with a few outliers: weighted median of their squares over that of a
/// chi-square variable with one degree of freedom. Requirement: at least one, weights > 0.
double typical_variance(std::vector<WeighedSquare> squares);

struct ProbabilityInterval {
  double lower = 0, upper = 1;
};

/// Clopper-Pearson 95 % interval (Biometrika 26 (1934) 404) of a probability, from `count` occurrences in `trials`:
/// quantiles 0.025 of Beta(k, n - k + 1) and 0.975 of Beta(k + 1, n - k). Coverage is at least 95 %. Requirements: 0 <=
/// count <= trials, trials >= 1.
ProbabilityInterval binomial_interval(int count, int trials);

/// Lower 95 % limit of the standard deviation of a population, from that of a normal sample: s sqrt((n -
/// 1)/chi^2(0.95; n - 1)). Requirement: n >= 2.
double least_deviation(const Sample& sample);

/// Factor on a standard deviation estimated from `readings` values, so that the true mean is within 1.96 standard
/// errors with probability 0.95: t(0.975; n - 1)/1.96. 1 for a single reading: its deviation is taken as known.
double widening(int readings);

}  // namespace pastefit
