#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/laws/normal.h"

namespace pastefit {

/// Stiff adhesive spheres (Derjaguin, Muller & Toporov 1975, with the contact area of Hertz and the attraction of rigid
/// spheres, as in LAMMPS and Yade). As in `Jkr` the work of adhesion is 2 gamma:
///     F = 4/3 E* sqrt(R*) d^(3/2) - 4 pi gamma R*,   d > 0.
/// The pull-off force is 4 pi gamma R*, at touch; there is no attraction across a gap, so that a cycle of approach and
/// separation loses no energy. Friction uses the elastic part, or with `total` F + 8 pi gamma R*, as in LAMMPS.
/// Scale-free: gamma over the mean radius, so that forces scale with R^2.
struct Dmt {
  static constexpr NormalLaw choice = NormalLaw::dmt;
  static constexpr std::string_view word = "dmt";
  static constexpr std::array<std::string_view, 2> parameters{"adhesion_pa", "cohesion_factor"};
  static constexpr bool adheres = true, reaches = false, yields = false, beside_bridges = false;

  template <class Value>
  static void make(ContactModel& contact, double radius, const Value& value) {
    contact.surface_energy_j_m2 = value("adhesion_pa") * radius;
  }
  static void set(PairConstants& pair, const ContactModel& grains, double share) {
    pair.adhesion = 4 * std::numbers::pi * share * grains.surface_energy_j_m2;
  }

  template <class Real>
  PASTEFIT_INLINE static NormalForce<Real> at(const ConstantsOf<Real>& k, Real sqrt_radius, Real overlap,
                                              Real touched) {
    NormalForce<Real> normal_force = Hertz::at(k, sqrt_radius, overlap, touched);
    const Real pull = select(normal_force.touching, k.adhesion * sqrt_radius * sqrt_radius, Real(0.0));
    normal_force.force = normal_force.load - pull;
    normal_force.reserve = Real(2.0) * pull;
    return normal_force;
  }
  template <class Real>
  PASTEFIT_INLINE static Real energy(const ConstantsOf<Real>&, Real, const NormalForce<Real>& normal_force,
                                     Real overlap) {
    const Real pull = normal_force.load - normal_force.force;
    return (Real(0.4) * normal_force.load - pull) * larger(overlap, Real(0.0));
  }
  /// 4 pi gamma a^2: of the contact area and its surroundings alike.
  static double surface(const PairConstants& k, double, double contact_radius) {
    return k.adhesion * contact_radius * contact_radius;
  }
  template <class Real>
  PASTEFIT_INLINE static Real widening(const ConstantsOf<Real>& k, Real radius, Real energy,
                                       Real inverse_contact_radius) {
    return Hertz::widening(k, radius, energy, inverse_contact_radius);
  }
  static double overlap_under(const PairConstants& k, double radius, double load) {
    return Hertz::overlap_under(k, radius, load + k.adhesion * radius);
  }
  /// Slow bodies oscillate about the equilibrium overlap.
  static double collision_time(const PairConstants& k, double radius, double mass, double speed) {
    const double stiffness = k.normal_stiffness * std::sqrt(radius * overlap_under(k, radius, 0));
    return std::min(Hertz::collision_time(k, radius, mass, speed), std::numbers::pi * std::sqrt(mass / stiffness));
  }
};

}  // namespace pastefit
