#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/laws/normal.h"

namespace pastefit {

/// Elastic spheres with an attraction proportional to the contact area ("simplified JKR" of LIGGGHTS):
///     F = 4/3 E* sqrt(R*) d^(3/2) - k A,   A = 2 pi R* d,   d > 0,
/// with k the cohesion energy density [J/m^3 = Pa]. A is the disc in which two spheres, or a sphere and a plane,
/// intersect, to first order in d/R*. LIGGGHTS's `sjkr` has the exact disc, pi (2 R* d - d^2/4) for equal grains, a
/// quarter of a percent less at d = R*/50; its `sjkr2` has 2 A, so that half of k there gives this law. The pull-off
/// force is 2/3 pi^3 k^3 R*^2/E*^2, at d = (pi k/E*)^2 R*; unlike that of JKR it decreases with the stiffness of the
/// grains. There is no attraction at touch or beyond, and a cycle of approach and separation loses no energy.
///
/// Friction uses the elastic part, or with `total` F without a reserve. k is scale-free.
struct Sjkr {
  static constexpr NormalLaw choice = NormalLaw::sjkr;
  static constexpr std::string_view word = "sjkr";
  static constexpr std::array<std::string_view, 2> parameters{"cohesion_energy_density_pa", "cohesion_factor"};
  static constexpr bool adheres = true, reaches = false, yields = false, beside_bridges = false;

  template <class Value>
  static void make(ContactModel& contact, double, const Value& value) {
    contact.cohesion_energy_density_pa = value("cohesion_energy_density_pa");
  }
  static void set(PairConstants& pair, const ContactModel& grains, double share) {
    pair.adhesion = 2 * std::numbers::pi * share * grains.cohesion_energy_density_pa;
  }

  template <class Real>
  PASTEFIT_INLINE static NormalForce<Real> at(const ConstantsOf<Real>& k, Real sqrt_radius, Real overlap,
                                              Real touched) {
    NormalForce<Real> normal_force = Hertz::at(k, sqrt_radius, overlap, touched);
    normal_force.force =
        normal_force.load - k.adhesion * normal_force.contact_radius * normal_force.contact_radius;  // a^2 = R* d
    return normal_force;
  }
  template <class Real>
  PASTEFIT_INLINE static Real energy(const ConstantsOf<Real>&, Real, const NormalForce<Real>& normal_force,
                                     Real overlap) {
    const Real pull = normal_force.load - normal_force.force;
    return (Real(0.4) * normal_force.load - Real(0.5) * pull) * larger(overlap, Real(0.0));
  }
  static double surface(const PairConstants& k, double radius, double contact_radius) {
    const double square = contact_radius * contact_radius;
    return 0.5 * k.adhesion * square * square / radius;
  }
  template <class Real>
  PASTEFIT_INLINE static Real widening(const ConstantsOf<Real>& k, Real radius, Real energy,
                                       Real inverse_contact_radius) {
    return Hertz::widening(k, radius, energy, inverse_contact_radius);
  }
  /// In x = sqrt(d) the force is h x^3 - c x^2; Newton steps from above never pass the root.
  static double overlap_under(const PairConstants& k, double radius, double load) {
    const double h = k.hertz * std::sqrt(radius), c = k.adhesion * radius;
    double x = c / h + std::cbrt(load / h);
    for (int step = 0; step < 60; ++step) {
      const double lower = x - ((h * x - c) * x * x - load) / ((3 * h * x - 2 * c) * x);
      if (!(lower < x)) break;
      x = lower;
    }
    return x * x;
  }
  /// Slow bodies oscillate about the equilibrium overlap, with dF/dd = pi k R* there.
  static double collision_time(const PairConstants& k, double radius, double mass, double speed) {
    return std::min(Hertz::collision_time(k, radius, mass, speed),
                    std::numbers::pi * std::sqrt(mass / (0.5 * k.adhesion * radius)));
  }
};

}  // namespace pastefit
