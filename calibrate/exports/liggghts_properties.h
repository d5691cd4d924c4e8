#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "calibrate/base/format.h"

namespace pastefit {

/// A matrix over the grains and each wall; walls do not meet each other.
inline std::string pairs_of(const std::vector<double>& values) {
  std::string out = format("peratomtypepair %zu", values.size());
  for (std::size_t row = 0; row < values.size(); ++row)
    for (std::size_t column = 0; column < values.size(); ++column)
      out += format(" %.17g", values[std::min(row, column) == 0 ? std::max(row, column) : std::min(row, column)]);
  return out;
}

}  // namespace pastefit
