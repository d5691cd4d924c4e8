#pragma once

#include "core/inline.h"
#include "core/laws/materials.h"

namespace pastefit {

/// Lightness of a solid sphere's surface over that of its mass: 1/m + r^2/I = 3.5/m with I = 2/5 m r^2.
inline constexpr double kSurfaceLightness = 3.5;

/// Constants of a pair of surfaces for all laws, computed once before a run. Lengths and forces of attraction refer to
/// reference grains; see `Bridge` for other sizes. In kernels they are packs with equal lanes.
template <class Real>
struct ConstantsOf {
  Real hertz{0};                   ///< 4/3 E* [Pa]
  Real normal_stiffness{0};        ///< 2 E*: S_n = 2 E* sqrt(R* d) [Pa]
  Real sqrt_normal_stiffness{0};   ///< sqrt(2 E*)
  Real tangential_ratio{0};        ///< S_t / S_n = 4 G*/E*
  Real damping{0};                 ///< 2 sqrt(5/6) beta(e); e is exact if the damped contact may pull at its end
  Real tangential_damping{0};      ///< the same times sqrt(S_t / S_n)
  Real spin_damping_share{0};      ///< largest damping of spins over that along the normals: 2.5 sqrt(S_t / S_n)
  Real lost_share{0};              ///< 1 - e^2: share of the energy lost in a head-on collision
  Real friction{0};                ///< Coulomb coefficient
  Real slip_limit{0};              ///< force of a sliding tangential spring over the repulsion
  bool friction_of_total = false;  ///< limit mu N with N the total normal force instead of the elastic repulsion
  Real friction_reserve{1};        ///< share of `NormalForce::reserve` added to that normal force
  Real rolling_friction{0};        ///< mu_r
  Real roll_stiffness_share{0};    ///< k_r/(I of a grain) over S_n/m: 2.25 mu_r^2/0.4
  Real roll_damping{0};            ///< 0.6 sqrt(1.4 * 2.25) mu_r: dashpot over sqrt(S_n m*) R*^2
  Real spin_damping{0};            ///< normal damping at which the damping of spins equals that of the rolling dashpot
  Real size_per_radius{0};         ///< 2/R_ref, for a wall 1/R_ref: size scale of a pair over its R* [1/m]
  Real adhesion{0};          ///< JKR pi gamma, DMT 4 pi gamma [J/m^2]; SJKR 2 pi k [Pa]; laws that `yield` k_c/k_1
  Real stiffening{1};        ///< laws that `yield`: k_2/k_1
  Real least_plastic{0};     ///< the same: plastic overlap over overlap while loading
  Real most_plastic{1};      ///< the same on the adhesion branch
  Real pull_off_patch{0};    ///< JKR: contact radius of reference grains at pull-off [m]
  Real pull_off_gap{0};      ///< largest gap of reference grains in contact, for a law that `reaches` [m]
  Real cohesion{0};          ///< constant attraction in overlap [N]
  bool passes_over = false;  ///< attraction at touch differs from `cohesion`: transition over `passage`
  Real touch_excess{0};      ///< attraction at touch minus the cohesion [N]
  Real passage{0};           ///< overlap of reference grains at which the transition ends [m]
  Real bridge_a{0};          ///< polynomial [N/m^2]; capillary: 2.5 R/V [1/m^2]
  Real bridge_b{0};          ///< polynomial [N/m]; linear c/|d_c|; exponential 3/|d_c| [1/m]; capillary 1.05 sqrt(R/V)
  Real bridge_c{0};          ///< attraction at touch [N]
  Real rupture_gap{0};       ///< -d_c [m]
  Real formation_gap{0};     ///< gap at which a bridge forms [m]
  Real viscosity{0};         ///< 6 pi times the viscosity of the liquid [Pa s]
  Real roughness{0};         ///< smallest gap in lubrication, for reference grains [m]
};
using PairConstants = ConstantsOf<double>;

/// The same numbers in all lanes.
template <class Real>
PASTEFIT_INLINE ConstantsOf<Real> in_lanes(const PairConstants& k) {
  return {Real(k.hertz),
          Real(k.normal_stiffness),
          Real(k.sqrt_normal_stiffness),
          Real(k.tangential_ratio),
          Real(k.damping),
          Real(k.tangential_damping),
          Real(k.spin_damping_share),
          Real(k.lost_share),
          Real(k.friction),
          Real(k.slip_limit),
          k.friction_of_total,
          Real(k.friction_reserve),
          Real(k.rolling_friction),
          Real(k.roll_stiffness_share),
          Real(k.roll_damping),
          Real(k.spin_damping),
          Real(k.size_per_radius),
          Real(k.adhesion),
          Real(k.stiffening),
          Real(k.least_plastic),
          Real(k.most_plastic),
          Real(k.pull_off_patch),
          Real(k.pull_off_gap),
          Real(k.cohesion),
          k.passes_over,
          Real(k.touch_excess),
          Real(k.passage),
          Real(k.bridge_a),
          Real(k.bridge_b),
          Real(k.bridge_c),
          Real(k.rupture_gap),
          Real(k.formation_gap),
          Real(k.viscosity),
          Real(k.roughness)};
}

/// Overlap over mean radius in which the attraction at touch changes to the cohesion, where they differ. A jump of the
/// force creates energy at any time step: a pair that is pulled together by the bridge and not held by the cohesion
/// oscillates across touch for ever. A narrower transition is stiffer.
inline constexpr double kPassage = 0.01;

/// Smallest gap of lubrication over the mean radius: LIGGGHTS's recommended minSeparationDistanceRatio of 1.01
/// (cohesion washino/capillary/viscous), i.e. a roughness of each grain of 1 % of its radius.
inline constexpr double kRoughness = 0.02;

/// Grain against grain. `reference_radius_m`: grain size that the bridge constants refer to. Sources: Hertz, Mindlin;
/// damping of Tsuji et al. in the form beta = -ln e / sqrt(ln^2 e + pi^2).
PairConstants grain_pair(const ContactModel& grains, double reference_radius_m);

/// Grain against wall: friction, restitution and rolling of the wall, and its share of the grains' attraction. A wall
/// has no liquid shell: a bridge to it forms at the offset of one grain.
PairConstants wall_pair(const ContactModel& grains, const WallContact& wall, double reference_radius_m);

/// Damping factor beta of a restitution 0 < e <= 1.
double damping_ratio(double restitution);

/// Attraction at touch [N] and rupture gap [m] of a bridge of any shape between two reference grains.
double attraction_at_touch(const Bridge& bridge, double reference_radius_m);
double rupture_gap(const Bridge& bridge, double reference_radius_m);

/// Attraction of two reference grains at an overlap d, -rupture gap <= d <= 0 [N], as the engine computes it.
double bridge_force(const Bridge& bridge, double reference_radius_m, double overlap);

/// Overlap over diameter, d/(2R), at which repulsion balances attraction of two touching reference grains; for Hertz
/// 4/3 E* sqrt(R/2) d^(3/2) = cohesion. Columns are within a third of it: 30 % more at 40,000 Pa, where grains are also
/// pulled across gaps.
double resting_overlap(const ContactModel& grains, double reference_radius_m);

}  // namespace pastefit
