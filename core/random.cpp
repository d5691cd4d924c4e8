#include "core/random.h"

#include <cmath>
#include <numbers>

namespace pastefit {

double RandomStream::normal(std::uint64_t n) const {
  const double u = 1 - uniform(2 * n), v = uniform(2 * n + 1);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

}  // namespace pastefit
