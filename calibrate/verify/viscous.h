#pragma once

#include "calibrate/verify/formulas.h"

namespace pastefit {

/// Closed forms of two grains, or a grain and a wall, with a viscous bridge, from their own equations, independent of
/// the engine (core/laws). C_n = 6 pi mu R*^2, C_t = 6 pi mu R* (8/15 ln(R*/h) + 0.9588), h the gap; of a wall its
/// share of the attraction counts. The bridge's attraction is not in them: they hold where it is small beside.
/// Requirements: a pair; the bridge lives.

/// Resistance against parting, C_n v/h at a gap, at least the roughness; v the speed at which the pair parts [N].
Result<double> squeeze_force(const Impact& scene, const FormulaArguments& arguments);

/// Speed of approach after the test's duration, without other forces: v = v0 - C_n/m* ln(h0/h), dh/dt = -v, by
/// integration over ln h. Errors: the pair comes nearer than the roughness.
Result<double> squeezed_speed(const Impact& scene, const FormulaArguments& arguments);

/// Overlap -h after the test's duration of a grain that a constant force, its weight, presses on a wall, without
/// inertia: h = h0 exp(-m g t/C_n). Errors: it comes nearer than the roughness.
Result<double> settled_overlap(const Impact& scene, const FormulaArguments& arguments);

/// Velocity and spin of a grain of a pair that slides past each other at a gap that stays, after the test's duration:
/// the sliding velocity decays with the rate C_t (1/m* + sum of (r + h/2)^2/I).
Result<double> sheared_velocity(const Impact& scene, const FormulaArguments& arguments);
Result<double> sheared_spin(const Impact& scene, const FormulaArguments& arguments);

}  // namespace pastefit
