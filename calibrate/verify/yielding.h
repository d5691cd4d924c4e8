#pragma once

#include "calibrate/verify/formulas.h"

namespace pastefit {

/// Closed forms of one cycle of a contact with elasto-plastic adhesion (`epa`, exponent 3/2; `luding`, 1), from the
/// branches of its law, independent of the engine (core/laws): loaded to the overlap D, then unloaded down to the
/// adhesion branch and along it. D is the overlap at which a held second grain turns, or that of a start at rest; of
/// free grains the one at which the loading branch has taken up their speed. Of a wall its share of the adhesion
/// counts.
///
/// Attraction less repulsion at a gap, a negative one being an overlap, on the way apart [N]; the work lost in the
/// cycle [J]; the relative speed after a collision without dashpot, 0 if the grains stick [m/s]. Requirements: a pair
/// that approaches or overlaps; no friction.
Result<double> epa_force(const Impact& scene, const FormulaArguments& arguments);
Result<double> epa_loop_area(const Impact& scene, const FormulaArguments& arguments);
Result<double> epa_rebound_speed(const Impact& scene, const FormulaArguments& arguments);

}  // namespace pastefit
