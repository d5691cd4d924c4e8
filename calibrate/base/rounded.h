#pragma once

#include <cstdlib>

#include "calibrate/base/format.h"

namespace pastefit {

/// The number with so many digits, as JSON then writes it: a point that is drawn needs no more.
inline double rounded(double value, int digits = 5) {
  return std::strtod(format("%.*g", digits, value).c_str(), nullptr);
}

}  // namespace pastefit
