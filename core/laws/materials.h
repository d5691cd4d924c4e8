#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace pastefit {

/// Distribution of grain radii.
enum class SizeDistribution { mono, uniform, normal };

/// Grain radii of a simulation. mono: every grain has `radius_m`. uniform: between `smallest_m` and `largest_m`.
/// normal: mean `radius_m`, `standard_deviation_m`; values outside [smallest_m, largest_m] are redrawn.
struct GrainSizes {
  SizeDistribution distribution = SizeDistribution::mono;
  double radius_m = 0.008;  ///< mean radius
  double standard_deviation_m = 0;
  double smallest_m = 0.008;
  double largest_m = 0.008;
};

// Names of the laws. core/laws/table.h has a row for each, in the same order; `last` is the last name.

/// Normal force of overlapping bodies.
enum class NormalLaw {
  hertz,   ///< elastic spheres
  jkr,     ///< adhesive elastic spheres: Johnson, Kendall & Roberts 1971
  dmt,     ///< adhesive stiff spheres: Derjaguin, Muller & Toporov 1975
  sjkr,    ///< Hertz and an attraction proportional to the contact area
  epa,     ///< elasto-plastic adhesion, loading as Hertz: Thakur et al. 2014 (EEPA)
  luding,  ///< the same with linear springs: Luding 2008
  last = luding
};

/// How the attraction of a liquid bridge decreases with the gap; all have the value c at touch.
enum class BridgeShape {
  none,         ///< no attraction across a gap
  polynomial,   ///< a d^2 + b d + c
  linear,       ///< decreases linearly to zero at d_c
  exponential,  ///< c exp(3 d/|d_c|), cut off at d_c
  capillary,    ///< liquid bridge of two equal spheres, Willett et al. 2000
  last = capillary
};

// Beyond these a time step does not resolve the spring k_2, and a heap is one lump.
inline constexpr double kMostPlastic = 0.98, kMostAdhesive = 20;

/// Resistance to rolling.
enum class RollingModel {
  none,
  spring_dashpot,   ///< elastic-plastic spring and dashpot, Ai et al. 2011 (EPSD)
  constant_torque,  ///< mu_r N R* against the relative spin, regularised near rest
  last = constant_torque
};

/// Condition for a liquid bridge to form; it lives until the gap exceeds -d_c.
enum class BridgeFormation {
  film,  ///< the liquid shells touch: gap <= o_i + o_j
  touch  ///< the grains touch: gap <= 0
};

/// Attraction across the gap of two grains of the reference radius (the mean radius of the scene).
/// F(d) = a d^2 + b d + c for d_c <= d <= 0 (d < 0 is a gap), zero beyond.
/// Other pairs scale with s = 2 R*/R_ref: a unchanged, b s, c s^2, d_c s, offset s.
/// Requirements (polynomial): c > 0, b >= 0, b + 2 a d_c >= 0, F(d_c) >= 0, d_c < 0.
/// Source: Platzer & Fimbinger, BHM 167 (2022) 61-65.
struct Bridge {
  BridgeShape shape = BridgeShape::none;
  BridgeFormation formation = BridgeFormation::film;
  double a_n_m2 = 0;               ///< [N/m^2]
  double b_n_m = 0;                ///< [N/m]
  double c_n = 0;                  ///< [N], attraction at touch
  double d_c_m = 0;                ///< [m], overlap at rupture, negative
  double offset_m = 0;             ///< thickness of the liquid shell on each grain [m]
  double liquid_volume_m3 = 0;     ///< capillary only
  double surface_tension_n_m = 0;  ///< capillary only
  double contact_angle_rad = 0;    ///< capillary only
  double viscosity_pa_s = 0;       ///< of the liquid, the same for grains of any size (lubrication.h)
};

/// Normal force N in the friction limit mu N.
enum class FrictionBasis {
  elastic,  ///< elastic repulsion (cohesion increases friction)
  total,    ///< total normal force plus the reserve of an adhesive normal law; never negative
  net       ///< total normal force without a reserve; never negative
};

/// Grain against grain.
struct ContactModel {
  double youngs_modulus_pa = 2e6;
  double poissons_ratio = 0.3;
  double restitution = 0.3;
  double friction = 0.5;
  double rolling_friction = 0.1;
  NormalLaw normal = NormalLaw::hertz;
  double surface_energy_j_m2 = 0;         ///< gamma, half the work of adhesion; for adhesive normal laws [J/m^2]
  double cohesion_energy_density_pa = 0;  ///< k of `Sjkr`, attraction over contact area [J/m^3]
  double plasticity_ratio = 0;            ///< `Epa` and `Luding`, 1 - k_1/k_2: plastic share of an overlap
  double adhesion_ratio = 0;              ///< the same, k_c/k_1: stiffness of the adhesion branch over that of loading
  RollingModel rolling = RollingModel::spring_dashpot;
  FrictionBasis friction_basis = FrictionBasis::elastic;
  std::optional<double> cohesion_n;  ///< constant attraction in overlap [N] at the reference radius; empty: bridge.c_n
  Bridge bridge;
};

/// The same material for grains k times as large: forces scale with k^2, the bridge's b with k; its a and its viscosity
/// are unchanged, so that F/R^2 is the same function of d/R. Requirement: k > 0.
ContactModel enlarged(ContactModel model, double k);
/// All lengths times k.
GrainSizes enlarged(GrainSizes grains, double k);

/// Grain against a wall; by default the wall is stiff.
struct WallContact {
  double youngs_modulus_pa = 1e9;
  double poissons_ratio = 0.3;
  double restitution = 0.3;
  double friction = 0.5;
  double rolling_friction = 0.1;
  double cohesion_factor = 0;  ///< share of the grains' cohesion and bridge force that acts on this wall
};

}  // namespace pastefit
