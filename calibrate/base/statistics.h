#pragma once

#include <span>
#include <vector>

namespace pastefit {

/// Count, mean and standard deviation of some readings.
struct Sample {
  int count = 0;
  double mean = 0;
  double standard_deviation = 0;  ///< of one reading; 0 for a single one
};

/// Readings that are all the same have no deviation, to the last bit.
Sample sample_of(std::span<const double> values);

/// How far the means of two samples of one population lie apart at most, except with probability `false_alarm`:
///     t(1 - false_alarm/2; n + m - 2) s sqrt(1/n + 1/m),   s^2 = ((n-1) s_1^2 + (m-1) s_2^2)/(n + m - 2),
/// the two-sided t-interval for a difference of means with pooled variance (Student). Readings of the same packing are
/// positively correlated, if at all, which makes false alarms rarer.
/// 0: neither sample has any scatter but the rounding of sums.
/// Requirement: n + m >= 3, n, m >= 1.
double band_of(const Sample& first, const Sample& second, double false_alarm);

/// The same for samples of different populations whose scatter need not be equal (Welch): here the simulation and the
/// laboratory. The deviation of a sample of one reading counts as known.
double unequal_band_of(const Sample& first, const Sample& second, double false_alarm);

/// Whether two means lie no farther apart than their band; where it is 0, than the rounding of sums: 1e-9 of their
/// size.
bool lie_within(double band, double first, double second);

struct WeighedSquare {
  double square = 0, weight = 1;
};

/// Variance of normal variables of mean 0 that a few of another kind are mixed with: the weighted median of their
/// squares over that of a chi-square variable of one degree of freedom. Requirement: one at least, weights > 0.
double typical_variance(std::vector<WeighedSquare> squares);

/// Ends of an interval for a probability.
struct ProbabilityInterval {
  double lower = 0, upper = 1;
};

/// The 95 % interval of Clopper and Pearson (Biometrika 26 (1934) 404) for the probability of what happened `count`
/// times in `trials`: the quantiles 0.025 of Beta(k, n - k + 1) and 0.975 of Beta(k + 1, n - k). It holds the truth at
/// least that often. Requirements: 0 <= count <= trials, trials >= 1.
ProbabilityInterval binomial_interval(int count, int trials);

/// How much wider than a known one a deviation has to be taken that was estimated from so many readings, so that their
/// mean lies within 1.96 of its standard errors of the truth with a probability of 0.95:
///     t(0.975; n - 1)/1.96.
/// 1 for a single reading: its deviation counts as known.
double widening(int readings);

}  // namespace pastefit
