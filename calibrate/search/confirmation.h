#pragma once

#include "calibrate/search/objective.h"

namespace pastefit {

/// What the mean of a candidate over fresh packings says of it.
enum class Verdict {
  holds,     ///< it meets the laboratory
  refuted,   ///< it misses the laboratory by more than the tolerance, noise or not; or some packing failed
  undecided  ///< the packings scatter too much to tell
};

/// Judges a candidate by its answer on packings it was not chosen on. With the misfit m and the part s that the noise
/// of the packings makes by itself (`Response::noise_mm`):
///     holds      m <= tolerance and s <= tolerance
///     refuted    sqrt(m^2 - s^2) > tolerance; the mean of m^2 over fillings is that of a mean without noise, plus s^2
///     undecided  otherwise
/// Requirement: tolerance_mm > 0. Limit: of a single packing the noise is not known and counts as none.
Verdict verdict_on(const Response& response, double tolerance_mm);

/// The same by the numbers.
Verdict verdict_on(double misfit_mm, double noise_mm, double tolerance_mm);

}  // namespace pastefit
