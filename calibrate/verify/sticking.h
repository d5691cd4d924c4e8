#pragma once

#include "calibrate/verify/formulas.h"

namespace pastefit {

/// Closed forms of contacts that stick, from their own equations, independent of the engine (core/laws): attraction
/// less repulsion at a gap, a negative one being an overlap [N], what it takes to part the pair [N], and what that
/// costs [J]. Of a wall, its share of the grains' attraction counts.
///
/// JKR (Johnson, Kendall & Roberts 1971): F = 4 E* a^3/(3 R*) - 4 sqrt(pi gamma E*) a^(3/2), d = a^2/R* - sqrt(4 pi
/// gamma a/E*), by bisection. DMT: F = 4/3 E* sqrt(R*) d^(3/2) - 4 pi gamma R*. SJKR: the same repulsion less 2 pi k R*
/// d. Requirements: a pair; gamma or k > 0. Errors: JKR at a gap that no contact reaches.
Result<double> jkr_force(const Impact& scene, const FormulaArguments& arguments);
Result<double> jkr_pull_off(const Impact& scene, const FormulaArguments& arguments);
Result<double> jkr_loop_area(const Impact& scene, const FormulaArguments& arguments);
Result<double> dmt_force(const Impact& scene, const FormulaArguments& arguments);
Result<double> dmt_pull_off(const Impact& scene, const FormulaArguments& arguments);
Result<double> sjkr_force(const Impact& scene, const FormulaArguments& arguments);
Result<double> sjkr_pull_off(const Impact& scene, const FormulaArguments& arguments);

/// Relative speed after an elastic collision of a JKR pair that comes from afar; 0 if it sticks.
Result<double> speed_after_parting(const Impact& scene, const FormulaArguments& arguments);

}  // namespace pastefit
