#include "calibrate/check/misfit.h"

#include <algorithm>
#include <cmath>

namespace pastefit {

Misfit fitted_misfit(std::span<const CardTest> tests) {
  Misfit largest;
  for (const auto& test : tests) {
    if (test.hold_out) continue;
    for (const auto& observable : test.observables) {
      if (!observable.measured || observable.weight <= 0) continue;
      ++largest.readings;
      largest.difference =
          std::max(largest.difference, std::abs(observable.simulated - *observable.measured) / observable.tolerance);
      largest.noise = std::max(largest.noise, standard_error(observable).value_or(0) / observable.tolerance);
    }
  }
  return largest;
}

}  // namespace pastefit
