#pragma once

#include <cstdlib>
#include <string>

#include "calibrate/base/format.h"

namespace pastefit {

/// The number with so many digits, as JSON then writes it: a point that is drawn needs no more.
inline double rounded(double value, int digits = 5) {
  return std::strtod(format("%.*g", digits, value).c_str(), nullptr);
}

/// The number with so many digits as people write it: "11900", where printf has "1.19e+04".
inline std::string plain(double value, int digits = 3) {
  return format("%.9g", rounded(value, digits));
}

}  // namespace pastefit
