#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/laws/normal.h"

namespace pastefit {

/// Adhesive elastic spheres (Johnson, Kendall & Roberts 1971), in the convention of Karkala et al., Processes 7 (2019)
/// 278, and of EDEM, in which the work of adhesion is 2 gamma:
///     F = 4 E* a^3/(3 R*) - 4 sqrt(pi gamma E*) a^(3/2),   d = a^2/R* - sqrt(4 pi gamma a/E*).
/// The pull-off force is 3 pi gamma R*; the attraction at d = 0 is 8/3 pi gamma R*. Bodies that have touched attract
/// each other until the contact becomes unstable: at a_t = (pi gamma R*^2/(4 E*))^(1/3), d = -3 a_t^2/R*, where F =
/// -5/3 pi gamma R*. (EDEM ends the contact at 0.917 a_t, a third of a percent earlier in d.)
///
/// With y = sqrt(a/a_t) and f = pi gamma R*: F = f (y^6/3 - 2 y^3), d = (a_t^2/R*) (y^4 - 4 y), y >= 1. To solve d for
/// y take (y - 1) sqrt(y^2 + 2 y + 3) = w, w^2 = 3 + d R*/a_t^2, which has no double root: three Newton steps from the
/// upper bound sqrt(1 + w) are accurate to 2e-14.
///
/// Friction uses the elastic part f y^6/3, or with `total` F + 6 f, as in LAMMPS. Scale-free: gamma over the mean
/// radius, so that forces scale with R^2.
struct Jkr {
  static constexpr NormalLaw choice = NormalLaw::jkr;
  static constexpr std::string_view word = "jkr";
  static constexpr std::array<std::string_view, 2> parameters{"adhesion_pa", "cohesion_factor"};
  static constexpr bool adheres = true, reaches = true, yields = false, beside_bridges = true;

  template <class Value>
  static void make(ContactModel& contact, double radius, const Value& value) {
    contact.surface_energy_j_m2 = value("adhesion_pa") * radius;
  }
  static void set(PairConstants& pair, const ContactModel& grains, double share) {
    const double radius = 1 / pair.size_per_radius, modulus = 0.5 * pair.normal_stiffness;
    pair.adhesion = std::numbers::pi * share * grains.surface_energy_j_m2;
    pair.pull_off_patch = std::cbrt(pair.adhesion * radius * radius / (4 * modulus));
    pair.pull_off_gap = 3 * pair.pull_off_patch * pair.pull_off_patch / radius;
  }

  template <class Real>
  PASTEFIT_INLINE static NormalForce<Real> at(const ConstantsOf<Real>& k, Real sqrt_radius, Real overlap,
                                              Real touched) {
    const Real zero(0.0), one(1.0), radius = sqrt_radius * sqrt_radius, patch = pull_off_patch(k, radius);
    const Real left = fused(overlap, radius / (patch * patch), Real(3.0));  // distance to the end of the contact
    const auto touching = select(touched > zero, left, overlap) > zero;
    const Real w = square_root(larger(left, zero));
    Real y = square_root(one + w);
    for (int step = 0; step < 3; ++step) {
      const Real square = fused(y, y + Real(2.0), Real(3.0));
      y = y - fused(y - one, square, -(w * square_root(square))) / (Real(2.0) * fused(y, y + one, one));
    }
    const Real unit = k.adhesion * radius, cube = y * y * y;
    const Real load = Real(1.0 / 3) * unit * cube * cube;
    return {touching, select(touching, patch * y * y, zero), select(touching, load - Real(2.0) * unit * cube, zero),
            select(touching, load, zero), select(touching, Real(6.0) * unit, zero)};
  }
  /// f (a_t^2/R*) (2/15 y^10 - 4/3 y^7 + 2 y^4 - 4/5).
  template <class Real>
  PASTEFIT_INLINE static Real energy(const ConstantsOf<Real>& k, Real radius, const NormalForce<Real>& normal_force,
                                     Real) {
    const Real unit = k.adhesion * radius, patch = pull_off_patch(k, radius), a = normal_force.contact_radius;
    const Real mean =
        Real(0.4) * normal_force.load - Real(2.0 / 3) * (normal_force.load - normal_force.force) + Real(2.0) * unit;
    return select(normal_force.touching, (mean * a * a - Real(0.8) * unit * patch * patch) / radius, Real(0.0));
  }
  /// Work of adhesion times the area, 2 gamma pi a^2.
  static double surface(const PairConstants& k, double, double contact_radius) {
    return 2 * k.adhesion * contact_radius * contact_radius;
  }
  /// Minus `energy` at d = 0, where y^3 = 4.
  template <class Real>
  PASTEFIT_INLINE static Real spent(const ConstantsOf<Real>& k, Real radius) {
    const Real patch = pull_off_patch(k, radius);
    return Real(8.4195250494473572) * k.adhesion * patch * patch;
  }
  /// That of Hertz over 1 - y^-3; bounded, because the area of a separating contact shrinks without bound at its end.
  template <class Real>
  PASTEFIT_INLINE static Real widening(const ConstantsOf<Real>& k, Real radius, Real energy,
                                       Real inverse_contact_radius) {
    const Real shrunk = pull_off_patch(k, radius) * inverse_contact_radius;
    const Real stable = larger(Real(1.0) - shrunk * square_root(shrunk), Real(0.1));
    return Hertz::widening(k, radius, energy, inverse_contact_radius) / stable;
  }
  static double overlap_under(const PairConstants& k, double radius, double load) {
    const double y = std::cbrt(3 + std::sqrt(9 + 3 * load / (k.adhesion * radius)));
    const double patch = pull_off_patch(k, radius);
    return patch * patch / radius * (y * y * y - 4) * y;
  }
  /// Slow bodies oscillate about the equilibrium overlap, with dF/dd = 3/10 f y^2 R*/a_t^2, y^3 = 6.
  static double collision_time(const PairConstants& k, double radius, double mass, double speed) {
    const double patch = pull_off_patch(k, radius),
                 stiffness = 0.3 * std::cbrt(36.0) * k.adhesion * radius * radius / (patch * patch);
    return std::min(Hertz::collision_time(k, radius, mass, speed), std::numbers::pi * std::sqrt(mass / stiffness));
  }

 private:
  /// a_t of a pair. Cube root: s^(5/16) is accurate to 10 % for size ratios up to a hundred, and each Halley step
  /// trebles the number of correct digits.
  template <class Real>
  PASTEFIT_INLINE static Real pull_off_patch(const ConstantsOf<Real>& k, Real radius) {
    const Real s = k.size_per_radius * radius, fourth = square_root(square_root(s));
    Real root = fourth * square_root(square_root(fourth));
    for (int step = 0; step < 3; ++step) {
      const Real cube = root * root * root;
      root = root * (cube + Real(2.0) * s) / (Real(2.0) * cube + s);
    }
    return k.pull_off_patch * root * root;
  }
};

}  // namespace pastefit
