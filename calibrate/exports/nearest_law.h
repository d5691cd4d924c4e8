#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibrate/exports/export.h"
#include "core/laws/materials.h"
#include "core/result.h"

namespace pastefit {

/// The laws that a target can express. A law that is added later is not among them until its exporter says so.
struct KnownLaws {
  std::string_view target;  ///< as people call it
  std::vector<NormalLaw> normal{NormalLaw::hertz};
  std::vector<RollingModel> rolling{RollingModel::none, RollingModel::spring_dashpot};
  std::vector<BridgeShape> attraction = {};  ///< empty: whatever the curve, as a table or a fit
  bool viscosity = false;                    ///< lubrication by the liquid of a bridge
};

inline const std::vector<NormalLaw> kAllNormal{NormalLaw::hertz, NormalLaw::jkr, NormalLaw::dmt,
                                               NormalLaw::sjkr,  NormalLaw::epa, NormalLaw::luding};
inline const std::vector<RollingModel> kAllRolling{RollingModel::none, RollingModel::spring_dashpot,
                                                   RollingModel::constant_torque};
inline const std::vector<BridgeShape> kAllAttractions{BridgeShape::none, BridgeShape::polynomial, BridgeShape::linear,
                                                      BridgeShape::exponential, BridgeShape::capillary};

/// A fault for each law of the contact that is not known.
Faults unknown_laws(const ContactModel& contact, const KnownLaws& known);

/// Two bodies that stick, as a law of the overlap has them, on the way apart and slowly.
struct Sticking {
  double pull_off_n = 0;                         ///< largest attraction
  double at_touch_n = 0;                         ///< attraction at an overlap of zero
  double resting_overlap_m = 0, part_gap_m = 0;  ///< where the force is zero; where they let go of each other
  double work_j = 0;                             ///< from rest until they have let go
  double load_n = 0, reserve_n = 0;              ///< elastic part of the force at rest, and what `total` adds to it
};

/// Of two grains, and of a grain on a wall; R* of the pair. All zero where nothing sticks.
Sticking sticking_of(const ContactModel& contact, double effective_radius_m);
Sticking sticking_of(const ContactModel& contact, const WallContact& wall, double radius_m);

/// The distances of a deck of two mean grains: from a good deal more than they overlap at rest to beyond the end of
/// their attraction [m].
struct Distances {
  double nearest_m = 0, farthest_m = 0;
};
Distances two_grain_distances(const ContactModel& contact, double radius_m);

/// Surface energy of DMT [J/m^2] that parts two bodies at this force, 4 pi gamma R*.
double dmt_surface_energy(double pull_off_n, double effective_radius_m);

/// Cohesion energy density of SJKR [Pa] that does: (3 F E*^2/(2 pi^3 R*^2))^(1/3), the inverse of its largest
/// attraction 2/3 pi^3 k^3 R*^2/E*^2. In place of JKR, with F = 3 pi gamma R*: (9 gamma E*^2/(2 pi^2 R*))^(1/3).
double sjkr_energy_density(double pull_off_n, double effective_radius_m, double effective_modulus_pa);

/// The card's contact with this law, DMT or SJKR, in place of its own law of grains that stick, such that two mean
/// grains are parted by the same force. The card's own where that is this law, or where nothing sticks.
ContactModel with_nearest_law(const ContactModel& contact, NormalLaw law, double radius_m);

/// What then differs, in numbers: of two mean grains overlap at rest, attraction at touch, gap and work of parting; of
/// the smallest and largest grains the pull-off; and what friction holds of grains that only stick, `held_n` in the
/// deck. Nothing if the laws are the same.
std::vector<std::string> differences_of_sticking(const ExportScene& scene, const ContactModel& written,
                                                 std::string_view target, double held_n);

/// "overlap_m,card_n,TARGET_n" of two mean grains that are pulled apart; repulsion is positive.
ExportFile sticking_curves(const ExportScene& scene, const ContactModel& written, std::string_view target);

/// Friction of two mean grains that only stick, over their coefficient, as the card has it [N].
double held_normal_force_n(const ContactModel& contact, const Sticking& sticking);

/// Lever of the spring that resists rolling, over R*: k_r = 2.25 S_n (lever R*)^2. Of a spring and dashpot mu_r, as on
/// the card (Ai et al. 2011). In place of a constant torque, which a target lacks, stands a stiff spring, as wide as
/// R*: it slips at the same moment after a turn that is small.
double rolling_spring_lever(RollingModel rolling, double rolling_friction);

/// How small: of two mean grains under a load [N]. Empty if the card has no constant torque.
std::string note_of_constant_torque(const ExportScene& scene, double load_n);

}  // namespace pastefit
