#pragma once

#include <vector>

#include "core/laws/materials.h"

namespace pastefit {

/// Radii of a pair of grains, which determine its forces.
struct GrainPair {
  double first_radius_m = 0, second_radius_m = 0;
  double reference_radius_m = 0;  ///< grain size to which the bridge's constants apply

  double effective_radius_m() const { return first_radius_m * second_radius_m / (first_radius_m + second_radius_m); }
  /// s = 2 R*/R_ref: attractions scale with s^2, their distances with s.
  double size_scale() const { return 2 * effective_radius_m() / reference_radius_m; }
};

/// Shear modulus of grains or wall, E/(2 (1 + nu)).
double shear_modulus_pa(const auto& surface) {
  return surface.youngs_modulus_pa / (2 * (1 + surface.poissons_ratio));
}

/// Attraction [N] of a bridge between two reference grains at overlap -rupture gap <= d <= 0, in closed form:
/// polynomial a d^2 + b d + c; linear c (1 + d/|d_c|); exponential c exp(3 d/|d_c|); capillary as Willett et al. 2000.
/// Independent of the engine's formulas, so that `check` and `verify` can compare both. Throws std::logic_error for a
/// shape without formula.
double closed_bridge_n(const Bridge& bridge, double reference_radius_m, double overlap_m);

/// Constant attraction [N] of two grains in overlap.
double cohesion_n(const ContactModel& contact, const GrainPair& pair);

/// Attraction [N] of a bridge at touch beyond `cohesion_n`; 0 without a bridge.
double touch_excess_n(const ContactModel& contact, const GrainPair& pair);

/// Attraction [N] of two grains at overlap `d`, positive if attractive. For -rupture_gap <= d <= 0: the existing
/// bridge; beyond: 0; for d > 0: the cohesion, with a linear transition from the bridge's force at touch up to d =
/// kPassage R_ref s.
double attraction_n(const ContactModel& contact, const GrainPair& pair, double overlap_m);

/// Elastic repulsion 4/3 E* sqrt(R*) d^(3/2) [N]; 0 without overlap.
double repulsion_n(const ContactModel& contact, const GrainPair& pair, double overlap_m);

/// Gaps [m] at which a bridge forms and ruptures; both 0 without a bridge.
struct BridgeGaps {
  double formation_m = 0, rupture_m = 0;
};
BridgeGaps bridge_gaps(const ContactModel& contact, const GrainPair& pair);

/// Row of a force table.
struct ForcePoint {
  double overlap_m = 0;
  double attraction_n = 0, repulsion_n = 0;
};

/// Table with `points` rows, equally spaced in overlap from the rupture gap to at least `deepest_m`; includes touch and
/// rupture.
std::vector<ForcePoint> force_table(const ContactModel& contact, const GrainPair& pair, double deepest_m, int points);

}  // namespace pastefit
