#pragma once

#include <vector>

#include "core/laws/materials.h"

namespace pastefit {

/// Two grains of a pair: the lengths on which its forces depend.
struct GrainPair {
  double first_radius_m = 0, second_radius_m = 0;
  double reference_radius_m = 0;  ///< size the bridge's numbers belong to

  double effective_radius_m() const { return first_radius_m * second_radius_m / (first_radius_m + second_radius_m); }
  /// s = 2 R*/R_ref: attractions go with s^2, their distances with s.
  double size_scale() const { return 2 * effective_radius_m() / reference_radius_m; }
};

/// Of the grains or of a wall: E/(2 (1 + nu)).
double shear_modulus_pa(const auto& surface) {
  return surface.youngs_modulus_pa / (2 * (1 + surface.poissons_ratio));
}

/// Attraction of a bridge between two reference grains at overlap -rupture gap <= d <= 0 [N], in closed form:
/// polynomial a d^2 + b d + c; linear c (1 + d/|d_c|); exponential c exp(3 d/|d_c|); capillary as Willett et al. 2000.
/// The formulas stand here apart from the engine's, so that `check` and `verify` hold the engine against them; a shape
/// without one is a mistake in the program, std::logic_error.
double closed_bridge_n(const Bridge& bridge, double reference_radius_m, double overlap_m);

/// Constant attraction of two grains that overlap [N].
double cohesion_n(const ContactModel& contact, const GrainPair& pair);

/// Attraction of a bridge at touch beyond that [N]; without a bridge none.
double touch_excess_n(const ContactModel& contact, const GrainPair& pair);

/// Attraction of two grains at overlap `d` [N], positive when they pull: the living bridge for -rupture_gap <= d <= 0,
/// zero beyond; for d > 0 the cohesion, to which the bridge's force at touch passes over along a straight line as far
/// as d = kPassage R_ref s.
double attraction_n(const ContactModel& contact, const GrainPair& pair, double overlap_m);

/// Elastic repulsion 4/3 E* sqrt(R*) d^(3/2) [N], zero without overlap.
double repulsion_n(const ContactModel& contact, const GrainPair& pair, double overlap_m);

/// Gaps of a pair at which a bridge forms and ruptures [m]; both zero without bridge.
struct BridgeGaps {
  double formation_m = 0, rupture_m = 0;
};
BridgeGaps bridge_gaps(const ContactModel& contact, const GrainPair& pair);

/// One row of a force table.
struct ForcePoint {
  double overlap_m = 0;
  double attraction_n = 0, repulsion_n = 0;
};

/// `points` rows, evenly spaced in overlap, with one of them at touch and one at rupture; from the rupture gap to at
/// least `deepest_m`.
std::vector<ForcePoint> force_table(const ContactModel& contact, const GrainPair& pair, double deepest_m, int points);

}  // namespace pastefit
