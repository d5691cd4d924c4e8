#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/apparatus/impact/approach.h"
#include "core/result.h"

namespace pastefit {

/// Arguments of a closed form besides the scene.
struct FormulaArguments {
  std::size_t grain = 0;
  std::string axis = "x";  ///< "x", "y" or "z"
  double gap_m = 0;
};

/// Required parts of a scene besides its first grain. The pair is the first grain with its partner: the second grain,
/// otherwise the first wall. A rotor is a plate, the first wall, that rotates freely about a hinge.
enum class FormulaNeeds { grain, pair, wall, rotor };

/// Pair of a scene. Requirement: it has one.
Approach pair_of(const Impact& scene);
/// Fraction of the grains' attraction that acts in the pair: for a wall, its own.
double share_of(const Impact& scene);
/// Relative speed of the pair after losing this work; 0 if the work exceeds its energy.
double speed_after(const Approach& pair, double work_j);
/// Component along "x", "y" or "z".
double along(const Vec3& v, const std::string& axis);
/// Fault of a scene outside the validity of a formula.
Fault outside(std::string what);

/// Closed form of a few-body test, a function of the scene.
struct Formula {
  std::string_view name;
  Result<double> (*value)(const Impact& scene, const FormulaArguments& arguments);
  std::string_view meaning;  ///< one line with formula and limits
  FormulaNeeds needs = FormulaNeeds::pair;
};

/// Evaluates a closed form. Errors: the scene lacks required parts, or is outside the validity.
Result<double> value_of(const Formula& formula, const Impact& scene, const FormulaArguments& arguments);

/// Every closed form that a case may name.
std::span<const Formula> formulas();

/// Closed forms of adhesive contacts, independent of the engine (core/laws): attraction less repulsion at a gap,
/// negative in overlap [N]; pull-off force of the pair [N]; work of separation [J]. For a wall, its share of the
/// grains' attraction counts.
///
/// JKR (Johnson, Kendall & Roberts 1971): F = 4 E* a^3/(3 R*) - 4 sqrt(pi gamma E*) a^(3/2), d = a^2/R* - sqrt(4 pi
/// gamma a/E*), by bisection. DMT: F = 4/3 E* sqrt(R*) d^(3/2) - 4 pi gamma R*. SJKR: the same repulsion less 2 pi k R*
/// d. Requirements: a pair; gamma or k > 0. Errors: JKR at a gap beyond the range of a contact.
Result<double> jkr_force(const Impact& scene, const FormulaArguments& arguments);
Result<double> jkr_pull_off(const Impact& scene, const FormulaArguments& arguments);
Result<double> jkr_loop_area(const Impact& scene, const FormulaArguments& arguments);
Result<double> dmt_force(const Impact& scene, const FormulaArguments& arguments);
Result<double> dmt_pull_off(const Impact& scene, const FormulaArguments& arguments);
Result<double> sjkr_force(const Impact& scene, const FormulaArguments& arguments);
Result<double> sjkr_pull_off(const Impact& scene, const FormulaArguments& arguments);

/// Relative speed after an elastic collision of an initially separated JKR pair; 0 if it sticks.
Result<double> speed_after_parting(const Impact& scene, const FormulaArguments& arguments);

/// Closed forms of one cycle of a contact with elasto-plastic adhesion (`epa`, exponent 3/2; `luding`, 1), from the
/// branches of its law, independent of the engine (core/laws): loading to the overlap D, then unloading to the adhesion
/// branch and along it. D is the overlap at which a held second grain reverses, or that of a start at rest; for free
/// grains, that at which the loading branch has absorbed their kinetic energy. For a wall, its share of the adhesion
/// counts.
///
/// Attraction less repulsion at a gap, negative in overlap, during separation [N]; work lost in the cycle [J]; relative
/// speed after a collision without dashpot, 0 if the grains stick [m/s]. Requirements: a pair that approaches or
/// overlaps; no friction.
Result<double> epa_force(const Impact& scene, const FormulaArguments& arguments);
Result<double> epa_loop_area(const Impact& scene, const FormulaArguments& arguments);
Result<double> epa_rebound_speed(const Impact& scene, const FormulaArguments& arguments);

/// Closed forms of two grains, or a grain and a wall, with a viscous bridge, independent of the engine (core/laws). C_n
/// = 6 pi mu R*^2, C_t = 6 pi mu R* (8/15 ln(R*/h) + 0.9588), h: gap; for a wall, its share of the attraction counts.
/// Limits: the bridge's attraction is neglected, so it must be small. Requirements: a pair; an existing bridge.

/// Resistance to separation C_n v/h [N] at a gap of at least the roughness; v: speed of separation.
Result<double> squeeze_force(const Impact& scene, const FormulaArguments& arguments);

/// Speed of approach after the test's duration, without other forces: v = v0 - C_n/m* ln(h0/h), dh/dt = -v, by
/// integration over ln h. Errors: the gap becomes smaller than the roughness.
Result<double> squeezed_speed(const Impact& scene, const FormulaArguments& arguments);

/// Overlap -h after the test's duration for a grain pressed on a wall by its weight, without inertia: h = h0 exp(-m g
/// t/C_n). Errors: the gap becomes smaller than the roughness.
Result<double> settled_overlap(const Impact& scene, const FormulaArguments& arguments);

/// Velocity and spin of a grain of a pair in relative sliding at constant gap, after the test's duration: the sliding
/// velocity decays with the rate C_t (1/m* + sum of (r + h/2)^2/I).
Result<double> sheared_velocity(const Impact& scene, const FormulaArguments& arguments);
Result<double> sheared_spin(const Impact& scene, const FormulaArguments& arguments);

}  // namespace pastefit
