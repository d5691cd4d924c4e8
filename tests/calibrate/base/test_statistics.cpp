#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "calibrate/base/statistics.h"
#include "core/random.h"

using namespace pastefit;

TEST_CASE("the band is exceeded as often as it says when nothing has changed") {
  const RandomStream noise(7, "check-noise");
  constexpr int kTrials = 20'000, kBefore = 5, kNow = 2;
  constexpr double kRate = 0.02;
  int alarms = 0, unequal_alarms = 0;
  std::uint64_t n = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> before, now, other;
    for (int i = 0; i < kBefore; ++i) before.push_back(100 + 3 * noise.normal(n++));
    for (int i = 0; i < kNow; ++i) now.push_back(100 + 3 * noise.normal(n++));
    for (int i = 0; i < 2 * kBefore; ++i) other.push_back(100 + 9 * noise.normal(n++));
    const auto first = sample_of(before), second = sample_of(now), third = sample_of(other);
    alarms += std::abs(first.mean - second.mean) > band_of(first, second, kRate);
    unequal_alarms += std::abs(first.mean - third.mean) > unequal_band_of(first, third, kRate);
  }
  CHECK(alarms == Approx(kRate * kTrials).margin(4 * std::sqrt(kRate * kTrials)));
  CHECK(unequal_alarms == Approx(kRate * kTrials).margin(4 * std::sqrt(kRate * kTrials)));
}

TEST_CASE("a deviation estimated from five readings is widened until the mean covers the truth in 95 %") {
  const RandomStream noise(8, "widening");
  constexpr int kTrials = 20'000, kReadings = 5;
  int covered = 0, without = 0;
  std::uint64_t n = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> readings;
    for (int i = 0; i < kReadings; ++i) readings.push_back(noise.normal(n++));
    const Sample sample = sample_of(readings);
    const double reach = 1.96 * sample.standard_deviation / std::sqrt(kReadings);
    covered += std::abs(sample.mean) <= widening(kReadings) * reach;
    without += std::abs(sample.mean) <= reach;
  }
  CHECK(covered == Approx(0.95 * kTrials).margin(4 * std::sqrt(0.05 * 0.95 * kTrials)));
  CHECK(without < 0.9 * kTrials);
  CHECK(widening(1) == 1);
}

TEST_CASE("readings that are all the same have no deviation, however many they are") {
  for (const std::size_t count : {2u, 3u, 7u, 49u}) {
    const Sample sample = sample_of(std::vector<double>(count, 0.1));
    CHECK(sample.mean == 0.1);
    CHECK(sample.standard_deviation == 0);
  }
}

TEST_CASE("readings without scatter may differ by rounding only") {
  const Sample fixed{4, 12.5, 0};
  CHECK(band_of(fixed, {4, 12.5, 0}, 1e-3) == 0);
  CHECK(band_of(fixed, {4, 12.5, 1e-15}, 1e-3) == 0);
  CHECK(unequal_band_of(fixed, {4, 12.5, 0}, 1e-3) == 0);
  CHECK(lie_within(0, 12.5, 12.5 + 1e-10));
  CHECK_FALSE(lie_within(0, 12.5, 12.5 + 1e-7));
  CHECK_FALSE(lie_within(0, 12.5, std::numeric_limits<double>::infinity()));
  CHECK(lie_within(2, 12.5, 14));
}

TEST_CASE("an interval of a share holds the truth in 95 of 100 samples or more, whatever the share") {
  constexpr int kTrials = 12;
  for (double truth = 0.005; truth < 1; truth += 0.005) {
    double covered = 0, chance = std::pow(1 - truth, kTrials);  // of 0 in 12
    for (int count = 0; count <= kTrials; ++count) {
      const ProbabilityInterval interval = binomial_interval(count, kTrials);
      if (interval.lower <= truth && truth <= interval.upper) covered += chance;
      chance *= (kTrials - count) / (count + 1.0) * truth / (1 - truth);
    }
    CAPTURE(truth);
    CHECK(covered >= 0.95);
  }
  // Where nothing or everything happened the interval has a closed form, and one end is certain.
  CHECK(binomial_interval(0, kTrials).lower == 0);
  CHECK(binomial_interval(0, kTrials).upper == Approx(1 - std::pow(0.025, 1.0 / kTrials)));
  CHECK(binomial_interval(kTrials, kTrials).lower == Approx(std::pow(0.025, 1.0 / kTrials)));
  CHECK(binomial_interval(kTrials, kTrials).upper == 1);
}
