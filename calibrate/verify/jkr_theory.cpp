#include "calibrate/verify/jkr_theory.h"

#include <cmath>
#include <numbers>

namespace pastefit {

namespace {

double overlap_of(const Approach& pair, double gamma, double patch) {
  return patch * patch / pair.radius - std::sqrt(4 * std::numbers::pi * gamma * patch / pair.modulus);
}

/// The larger of the contact radii that have this overlap, by bisection.
double patch_at(const Approach& pair, double gamma, double overlap) {
  double low = jkr_tear_patch(pair, gamma), high = 2 * low;
  while (overlap_of(pair, gamma, high) < overlap) high *= 2;
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    (overlap_of(pair, gamma, middle) < overlap ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double jkr_tear_patch(const Approach& pair, double gamma) {
  return std::cbrt(std::numbers::pi * gamma * pair.radius * pair.radius / (4 * pair.modulus));
}

double jkr_tear_gap(const Approach& pair, double gamma) {
  return -overlap_of(pair, gamma, jkr_tear_patch(pair, gamma));
}

double jkr_pull(const Approach& pair, double gamma, double gap) {
  const double patch = patch_at(pair, gamma, -gap);
  return 4 * std::sqrt(std::numbers::pi * gamma * pair.modulus) * std::pow(patch, 1.5) -
         4 * pair.modulus * std::pow(patch, 3) / (3 * pair.radius);
}

/// Simpson's rule in s, gap = end (1 - s^2), which takes away the root at the end.
double jkr_work(const Approach& pair, double gamma) {
  constexpr int kPanels = 1000;
  const double end = jkr_tear_gap(pair, gamma);
  const auto slope = [&](double s) { return 2 * s * end * jkr_pull(pair, gamma, end * (1 - s * s)); };
  double sum = 0;
  for (int k = 0; k < kPanels; ++k) sum += slope(k / 1e3) + 4 * slope((k + 0.5) / 1e3) + slope((k + 1) / 1e3);
  return sum / (6 * kPanels);
}

}  // namespace pastefit
