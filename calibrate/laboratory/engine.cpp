#include "calibrate/laboratory/engine.h"

#include "calibrate/base/text.h"
#include "core/laws/constants.h"

namespace pastefit {

std::optional<Failure> too_soft(const Test& test, const RunOptions& options) {
  const Specimen& specimen = specimen_of(test);
  const double overlap = 2 * resting_overlap(specimen.contact, specimen.grains.radius_m);  // in radii
  if (!(overlap > options.steps.overlap_limit)) return std::nullopt;
  Failure failure;
  failure.reason = FailureReason::excessive_overlap;
  failure.phase = "fill";
  failure.value = overlap;
  failure.limit = options.steps.overlap_limit;
  failure.message = format(
      "the grains' own attraction presses them into each other by %.3g radii; stiffer grains or "
      "less attraction",
      overlap);
  return failure;
}

}  // namespace pastefit
