#include "core/observe/steady_state.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/random.h"

namespace pastefit {
namespace {

/// Values about 100, each remembering the share `memory` of the one before; standard deviation 10.
std::vector<double> noisy_series(std::size_t n, double memory, std::uint64_t seed) {
  const RandomStream draws(seed, "series");
  std::vector<double> values;
  double deviation = 10 * draws.normal(0);
  for (std::size_t k = 0; k < n; ++k) {
    values.push_back(100 + deviation);
    deviation = memory * deviation + 10 * std::sqrt(1 - memory * memory) * draws.normal(k + 1);
  }
  return values;
}

TEST_CASE("the error of a steady mean is that of correlated noise, not of as many independent values") {
  constexpr std::size_t n = 1024;
  for (const double memory : {0.0, 0.8}) {
    // Of an autoregressive series of first order: sigma/sqrt(n) sqrt((1 + memory)/(1 - memory)).
    const double expected = 10 / std::sqrt(n) * std::sqrt((1 + memory) / (1 - memory));
    double sum = 0, off = 0;
    constexpr int seeds = 40;
    for (int seed = 1; seed <= seeds; ++seed) {
      const SteadyState steady = steady_state(noisy_series(n, memory, static_cast<std::uint64_t>(seed)));
      sum += steady.standard_error / seeds;
      off += std::pow((steady.mean - 100) / expected, 2) / seeds;
    }
    INFO(memory);
    // The largest over seven lengths of blocks is on the safe side, by up to a half.
    CHECK(sum > 0.9 * expected);
    CHECK(sum < 1.6 * expected);
    CHECK(off < 2);
  }
}

TEST_CASE("a start that fades away is cut off, and does not move the mean") {
  std::vector<double> values = noisy_series(512, 0.5, 5);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] -= 100 * std::exp(-static_cast<double>(k) / 30);
  const SteadyState steady = steady_state(values);
  CHECK(steady.reached);
  CHECK(steady.first > 60);
  CHECK(steady.first < 256);
  CHECK(std::fabs(steady.mean - 100) < 4 * steady.standard_error);
}

TEST_CASE("a series that still rises at its end is not steady") {
  std::vector<double> values = noisy_series(256, 0.5, 9);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] += 0.5 * static_cast<double>(k);
  CHECK_FALSE(steady_state(values).reached);
}

}  // namespace
}  // namespace pastefit
