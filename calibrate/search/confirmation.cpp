#include "calibrate/search/confirmation.h"

#include <algorithm>
#include <cmath>

#include "calibrate/search/response.h"

namespace pastefit {

Verdict verdict_on(const Response& response) {
  return is_whole(response) ? verdict_on(response.miss, response.noise) : Verdict::refuted;
}

Verdict verdict_on(double miss, double noise) {
  if (std::hypot(1, noise) < miss) return Verdict::refuted;
  return std::max(miss, noise) <= 1 ? Verdict::holds : Verdict::undecided;
}

double packings_to_decide(const Response& response) {
  return static_cast<double>(response.packings.size()) * response.noise * response.noise;
}

}  // namespace pastefit
