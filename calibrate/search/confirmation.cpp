#include "calibrate/search/confirmation.h"

#include <algorithm>
#include <cmath>

#include "calibrate/search/search_run.h"

namespace pastefit {

Verdict verdict_on(const Response& response, double tolerance_mm) {
  return is_whole(response) ? verdict_on(response.misfit_mm, response.noise_mm, tolerance_mm) : Verdict::refuted;
}

Verdict verdict_on(double misfit_mm, double noise_mm, double tolerance_mm) {
  if (std::hypot(tolerance_mm, noise_mm) < misfit_mm) return Verdict::refuted;
  return std::max(misfit_mm, noise_mm) <= tolerance_mm ? Verdict::holds : Verdict::undecided;
}

}  // namespace pastefit
