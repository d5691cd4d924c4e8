#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "core/laws/constants.h"
#include "core/laws/pack.h"

namespace pastefit {

/// Result of a normal law for a pair.
template <class Real>
struct NormalForce {
  decltype(Real() > Real()) touching;  ///< true if in contact
  Real contact_radius;                 ///< a [m]; gives the stiffnesses S_n = 2 E* a, S_t = 8 G* a. 0 out of contact
  Real force;                          ///< repulsion minus the law's own attraction [N]; 0 out of contact
  Real load;                           ///< its elastic part, never negative, for the friction limit [N]
  Real reserve;                        ///< added in the friction limit if that uses the total force [N]
  Real plastic{0};                     ///< laws that `yield`: overlap at which the spring is force-free now [m]
};

/// Normal laws: force and energy of two bodies as functions of the overlap d. Each is a type with
///     choice, word     its name in the program and in files;
///     parameters, make(contact, radius, value)   its scale-free parameters besides the elastic ones, and how they set
///                      its constants, as for an attraction (laws/attraction.h);
///     adheres          true if it attracts, and reduces to Hertz if PairConstants::adhesion is 0;
///     beside_bridges   true if an attraction across a gap is allowed besides: kernels of both are compiled;
///     reaches          true if bodies that have touched stay in contact beyond d = 0, at most to
///                      -PairConstants::pull_off_gap. `touched` > 0, the root of the last contact radius, marks them;
///     yields           true if it deforms plastically. `touched` is then the plastic overlap of the last step [m], and
///                      `NormalForce::plastic` that of this step;
///     set(pair, grains, share)   its constants of a pair, with `share` of its attraction (1 between grains); those of
///                      elasticity and size are set;
///     at(k, sqrt_radius, overlap, touched)   the `NormalForce` of a pair; sqrt_radius is sqrt(R*), radius R*;
///     energy(k, radius, force, overlap)   stored energy [J], 0 out of contact; its derivative by d is the force;
///     surface(k, radius, contact_radius)   if it `adheres`: work of adhesion of the contact patch [J]; `energy` plus
///                      this is the strain energy;
///     yielded(k, radius, before, after, middle)   if it `yields`: work [J] of a change of the plastic overlap at the
///                      overlap `middle`;
///     spent(k, radius)   if it `reaches`: minus its energy at first touch, the work of separation [J];
///     widening(k, radius, energy, inverse_contact_radius)   energy (da/dd)/a: force of a spring that grows with a [N];
///     overlap_under(k, radius, load)   d > 0 at which the force is `load` >= 0 [m];
///     collision_time(k, radius, mass, speed)   duration of a collision at this speed, for the time step [s].
/// The last two, and `set`, use plain numbers and run once; the others are computed in packs too (laws/pack.h). To add
/// one: core/README.md.

/// Elastic spheres: F = 4/3 E* sqrt(R*) d^(3/2), a = sqrt(R* d).
struct Hertz {
  static constexpr NormalLaw choice = NormalLaw::hertz;
  static constexpr std::string_view word = "hertz";
  static constexpr std::array<std::string_view, 0> parameters{};
  static constexpr bool adheres = false, reaches = false, yields = false, beside_bridges = true;

  template <class Value>
  static void make(ContactModel&, double, const Value&) {}
  static void set(PairConstants&, const ContactModel&, double) {}

  template <class Real>
  PASTEFIT_INLINE static NormalForce<Real> at(const ConstantsOf<Real>& k, Real sqrt_radius, Real overlap, Real) {
    const Real depth = larger(overlap, Real(0.0));
    const Real contact_radius = sqrt_radius * square_root(depth);
    const Real repulsion = k.hertz * contact_radius * depth;
    return {overlap > Real(0.0), contact_radius, repulsion, repulsion, Real(0.0)};
  }
  template <class Real>
  PASTEFIT_INLINE static Real energy(const ConstantsOf<Real>&, Real, const NormalForce<Real>& normal_force,
                                     Real overlap) {
    return Real(0.4) * normal_force.force * overlap;
  }
  template <class Real>
  PASTEFIT_INLINE static Real widening(const ConstantsOf<Real>&, Real radius, Real energy,
                                       Real inverse_contact_radius) {
    return Real(0.5) * energy * radius * inverse_contact_radius * inverse_contact_radius;
  }
  static double overlap_under(const PairConstants& k, double radius, double load) {
    return std::pow(load / (k.hertz * std::sqrt(radius)), 2.0 / 3);
  }
  static double collision_time(const PairConstants& k, double radius, double mass, double speed) {
    const double modulus = 0.5 * k.normal_stiffness;
    return 2.87 * std::pow(mass * mass / (radius * modulus * modulus * speed), 0.2);
  }
};

}  // namespace pastefit
