#pragma once

#include <span>

#include "calibrate/card/card.h"

namespace pastefit {

/// Of the fitted readings of some tests the largest difference from the laboratory and the largest standard error, each
/// over its tolerance, as in the search (`Response::normalised_error`, `Response::noise`). 0 where none is fitted.
struct Misfit {
  double difference = 0, noise = 0;
  int readings = 0;  ///< that are fitted
};

Misfit fitted_misfit(std::span<const CardTest> tests);

}  // namespace pastefit
