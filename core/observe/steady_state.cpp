#include "core/observe/steady_state.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pastefit {

namespace {

constexpr std::size_t kBatchLength = 4, kFewestBlocks = 8;

double average(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double squares_about_mean(std::span<const double> values) {
  const double mean = average(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum;
}

/// Means of blocks of this length, counted from the end; the remainder at the start is dropped.
std::vector<double> block_means(std::span<const double> values, std::size_t length) {
  std::vector<double> means;
  const std::size_t blocks = values.size() / length, left_over = values.size() - blocks * length;
  for (std::size_t b = 0; b < blocks; ++b) means.push_back(average(values.subspan(left_over + b * length, length)));
  return means;
}

double error_of_mean(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  return std::sqrt(squares_about_mean(values) / (n * (n - 1)));
}

/// The cut that minimises the error of the mean of the rest.
std::size_t best_cut(const std::vector<double>& batches) {
  std::size_t best = 0;
  double smallest = INFINITY;
  for (std::size_t k = 0; k <= 3 * batches.size() / 4; ++k) {
    const std::span<const double> rest = std::span(batches).subspan(k);
    const auto n = static_cast<double>(rest.size());
    const double error = squares_about_mean(rest) / (n * n);
    if (error >= smallest) continue;
    smallest = error;
    best = k;
  }
  return best;
}

}  // namespace

SteadyState steady_state(std::span<const double> values) {
  const std::size_t left_over = values.size() % kBatchLength;
  const std::size_t cut = best_cut(block_means(values, kBatchLength));
  SteadyState steady;
  steady.first = cut == 0 ? 0 : left_over + cut * kBatchLength;
  steady.reached = 2 * steady.first <= values.size();
  const std::span<const double> rest = values.subspan(steady.first);
  steady.mean = average(rest);
  for (std::size_t length = 1; rest.size() / length >= kFewestBlocks; length *= 2)
    steady.standard_error = std::max(steady.standard_error, error_of_mean(block_means(rest, length)));
  return steady;
}

}  // namespace pastefit
