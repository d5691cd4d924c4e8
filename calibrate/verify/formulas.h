#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/apparatus/impact/approach.h"
#include "core/result.h"

namespace pastefit {

/// What a closed form may be asked for besides the scene.
struct FormulaArguments {
  std::size_t grain = 0;
  std::string axis = "x";  ///< "x", "y" or "z"
  double gap_m = 0;
};

/// What a closed form reads off the scene besides its first grain. "The pair" is the first grain with its partner: the
/// second grain, or else the first wall. A rotor is a plate, the first wall, that turns freely about a hinge.
enum class FormulaNeeds { grain, pair, wall, rotor };

/// The pair of a scene that has one.
Approach pair_of(const Impact& scene);
/// Share of the grains' attraction that acts in the pair: of a wall its own.
double share_of(const Impact& scene);
/// The relative speed of the pair once this work is lost; 0 if it is more than the pair has.
double speed_after(const Approach& pair, double work_j);
/// The component along "x", "y" or "z".
double along(const Vec3& v, const std::string& axis);
/// A scene is beyond what the formula holds for.
Fault outside(std::string what);

/// A closed form of a few-body test; all it needs is the scene.
struct Formula {
  std::string_view name;
  Result<double> (*value)(const Impact& scene, const FormulaArguments& arguments);
  std::string_view meaning;  ///< one line with the formula and its limits
  FormulaNeeds needs = FormulaNeeds::pair;
};

/// The value of a closed form. Errors: the scene lacks what the formula needs, or is outside of its validity.
Result<double> value_of(const Formula& formula, const Impact& scene, const FormulaArguments& arguments);

/// Every closed form that a case may name.
std::span<const Formula> formulas();

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
