#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibrate/exports/export.h"
#include "core/laws/materials.h"
#include "core/result.h"

namespace pastefit {

/// Laws that a target supports. A new law is unsupported until its exporter lists it.
struct KnownLaws {
  std::string_view target;  ///< display name
  std::vector<NormalLaw> normal{NormalLaw::hertz};
  std::vector<RollingModel> rolling{RollingModel::none, RollingModel::spring_dashpot};
  std::vector<BridgeShape> attraction = {};  ///< empty: any curve, as a table or a fit
  bool viscosity = false;                    ///< lubrication by the liquid of a bridge
};

inline const std::vector<NormalLaw> kAllNormal{NormalLaw::hertz, NormalLaw::jkr, NormalLaw::dmt,
                                               NormalLaw::sjkr,  NormalLaw::epa, NormalLaw::luding};
inline const std::vector<RollingModel> kAllRolling{RollingModel::none, RollingModel::spring_dashpot,
                                                   RollingModel::constant_torque};
inline const std::vector<BridgeShape> kAllAttractions{BridgeShape::none, BridgeShape::polynomial, BridgeShape::linear,
                                                      BridgeShape::exponential, BridgeShape::capillary};

/// Faults for the unsupported laws of a contact.
Faults unknown_laws(const ContactModel& contact, const KnownLaws& known);

/// Adhesion of two bodies by a law of the overlap, during slow separation.
struct Sticking {
  double pull_off_n = 0;                         ///< largest attraction
  double at_touch_n = 0;                         ///< attraction at an overlap of zero
  double resting_overlap_m = 0, part_gap_m = 0;  ///< overlap of zero force; gap of separation
  double work_j = 0;                             ///< from rest to separation
  double load_n = 0, reserve_n = 0;              ///< elastic part of the force at rest; addition by `total`
};

/// For two grains, and for a grain and a wall; R* of the pair. All zero without adhesion.
Sticking sticking_of(const ContactModel& contact, double effective_radius_m);
Sticking sticking_of(const ContactModel& contact, const WallContact& wall, double radius_m);

/// Range of the motion of two mean grains in a deck [m]: from well beyond their overlap at rest to beyond the range of
/// their attraction.
struct Distances {
  double nearest_m = 0, farthest_m = 0;
};
Distances two_grain_distances(const ContactModel& contact, double radius_m);

/// Cohesion energy density [Pa] of SJKR with this pull-off force: (3 F E*^2/(2 pi^3 R*^2))^(1/3), the inverse of the
/// largest attraction 2/3 pi^3 k^3 R*^2/E*^2. As a substitute for JKR, F = 3 pi gamma R*: (9 gamma E*^2/(2 pi^2
/// R*))^(1/3).
double sjkr_energy_density(double pull_off_n, double effective_radius_m, double effective_modulus_pa);

/// The card's contact with `law`, DMT (pull-off 4 pi gamma R*) or SJKR, as a substitute with the same pull-off of two
/// mean grains. Unchanged if the card has that law or no adhesion.
ContactModel with_nearest_law(const ContactModel& contact, NormalLaw law, double radius_m);

/// Differences in numbers: for two mean grains overlap at rest, attraction at touch, gap and work of separation; for
/// the smallest and largest grains the pull-off; and the normal force in the friction limit of grains held by adhesion
/// only, `held_n` in the deck. Empty if the laws are the same.
std::vector<std::string> differences_of_sticking(const ExportScene& scene, const ContactModel& written,
                                                 std::string_view target, double held_n);

/// "overlap_m,card_n,TARGET_n" during separation of two mean grains; repulsion is positive.
ExportFile sticking_curves(const ExportScene& scene, const ContactModel& written, std::string_view target);

/// Friction limit over the friction coefficient of two mean grains held by adhesion only, in the card [N].
double held_normal_force_n(const ContactModel& contact, const Sticking& sticking);

/// Lever of the rolling spring over R*: k_r = 2.25 S_n (lever R*)^2. Spring-dashpot: mu_r, as on the card (Ai et al.
/// 2011). A target without constant torque gets a stiff spring with lever R*, which slips at the same moment after a
/// small rotation.
double rolling_spring_lever(RollingModel rolling, double rolling_friction);

/// Note on the size of that rotation for two mean grains under a load [N]; empty without constant torque.
std::string note_of_constant_torque(const ExportScene& scene, double load_n);

/// Liquid bridge of two equal spheres in LIGGGHTS' "cohesion easo/capillary/viscous", at contact angle 0 and without
/// viscosity:
///     F = pi gamma R (exp(A gap/R + B) + C),   A = -1.1 v^-0.53, B = 0.48 - 0.0082 ln v, C = 0.078 + 0.0018 ln v,
/// v = V/R^3; it forms at touch and ruptures at the gap V^(1/3). Source: Soulie, Cherblanc, El Youssoufi & Saix, Int.
/// J. Numer. Anal. Meth. Geomech. 30 (2006) 213-228; rupture as in LIGGGHTS-PUBLIC 3.8.0. Only contact angle 0 is used:
/// for others, LIGGGHTS 3.8.0 multiplies two angles instead of averaging them (27 % too strong at 30 degrees).
struct SoulieBridge {
  double radius_m = 0;
  double volume_m3 = 0;
  double surface_tension_n_m = 0;

  double force_n(double gap_m) const;
  double rupture_gap_m() const;
};

/// Bridge, and its difference from the card's: the largest and root mean square over the card's peak, and its work over
/// the card's, minus 1.
struct SoulieFit {
  SoulieBridge bridge;
  double largest = 0, root_mean_square = 0, work = 0;
};

/// Fits the bridge to the card's attraction of two grains of mean radius by least squares over 400 gaps up to the
/// larger rupture gap: 200 volumes, each with its optimal tension. Requirement: the contact attracts across a gap.
SoulieFit fit_soulie(const ContactModel& contact, double radius_m);

}  // namespace pastefit
