#include "calibrate/base/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace pastefit {

namespace {

double quantile(double freedom, double false_alarm) {
  constexpr double kNearlyNormal = 1e6;
  const boost::math::students_t distribution(std::min(freedom, kNearlyNormal));
  return boost::math::quantile(boost::math::complement(distribution, false_alarm / 2));
}

/// Rounding difference of the sums of two equal means.
double rounding(double first, double second) {
  return 1e-9 * std::max(std::min(std::abs(first), std::abs(second)), 1e-3);
}

}  // namespace

double widening(int readings) {
  constexpr double kOutside = 0.05, kNormalQuantile = 1.959963984540054;
  return readings > 1 ? quantile(readings - 1, kOutside) / kNormalQuantile : 1;
}

double least_deviation(const Sample& sample) {
  constexpr double kProbability = 0.95;
  const double freedom = sample.count - 1;
  return sample.standard_deviation *
         std::sqrt(freedom / boost::math::quantile(boost::math::chi_squared(freedom), kProbability));
}

ProbabilityInterval binomial_interval(int count, int trials) {
  constexpr double kBeyondEachEnd = 0.025;
  using Binomial = boost::math::binomial;
  return {Binomial::find_lower_bound_on_p(trials, count, kBeyondEachEnd),
          Binomial::find_upper_bound_on_p(trials, count, kBeyondEachEnd)};
}

Sample sample_of(std::span<const double> values) {
  Sample out;
  out.count = static_cast<int>(values.size());
  if (values.empty()) return out;
  out.mean = values.front();  // exact for equal values
  for (const double value : values) out.mean += (value - values.front()) / out.count;
  double squares = 0;
  for (const double value : values) squares += (value - out.mean) * (value - out.mean);
  if (out.count > 1) out.standard_deviation = std::sqrt(squares / (out.count - 1));
  return out;
}

double band_of(const Sample& first, const Sample& second, double false_alarm) {
  const double n = first.count, m = second.count, freedom = n + m - 2;
  const double squares = (n - 1) * first.standard_deviation * first.standard_deviation +
                         (m - 1) * second.standard_deviation * second.standard_deviation;
  const double band = quantile(freedom, false_alarm) * std::sqrt(squares / freedom * (1 / n + 1 / m));
  return band > rounding(first.mean, second.mean) ? band : 0;
}

double typical_variance(std::vector<WeighedSquare> squares) {
  constexpr double median_of_normal = 0.4549364231195724;
  std::ranges::sort(squares, {}, &WeighedSquare::square);
  double below = 0;
  for (const WeighedSquare& one : squares) below += one.weight / 2;
  for (const WeighedSquare& one : squares) {
    below -= one.weight;
    if (below <= 0) return one.square / median_of_normal;
  }
  return squares.back().square / median_of_normal;
}

double unequal_band_of(const Sample& first, const Sample& second, double false_alarm) {
  const auto square = [](const Sample& sample) {
    return sample.standard_deviation * sample.standard_deviation / sample.count;
  };
  const auto share = [&](const Sample& sample) {
    return sample.count > 1 ? square(sample) * square(sample) / (sample.count - 1) : 0.0;
  };
  const double variance = square(first) + square(second), shares = share(first) + share(second);
  const double freedom = shares > 0 ? variance * variance / shares : 1e6;
  const double band = quantile(freedom, false_alarm) * std::sqrt(variance);
  return band > rounding(first.mean, second.mean) ? band : 0;
}

bool lie_within(double band, double first, double second) {
  return std::abs(first - second) <= (band > 0 ? band : rounding(first, second));
}

}  // namespace pastefit
