#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "core/laws/constants.h"
#include "core/laws/pack.h"

namespace pastefit {

/// What a law of the overlap makes of a pair.
template <class Real>
struct NormalForce {
  decltype(Real() > Real()) touching;  ///< whether the bodies are in contact
  Real contact_radius;  ///< a [m]; stiffnesses follow from it: S_n = 2 E* a, S_t = 8 G* a. 0 out of contact
  Real force;           ///< repulsion less what the law itself attracts by [N]; 0 out of contact
  Real load;            ///< elastic part of it, never negative, that friction feels [N]
  Real reserve;         ///< what friction feels besides where it feels the total force [N]
  Real plastic{0};      ///< of a law that `yields`: overlap at which the force of its spring is zero now [m]
};

/// Laws of the overlap d: how hard two bodies press on each other, and what that holds. Each is a type with
///     choice, word     its name in the program and in files;
///     parameters, make(contact, radius, value)   scale-free numbers that it is made of besides those of elasticity,
///                      and how: as those of an attraction (laws/attraction.h);
///     adheres          whether it attracts, and is Hertz where PairConstants::adhesion is 0;
///     beside_bridges   whether it may be chosen beside an attraction across a gap: kernels of both are compiled;
///     reaches          whether it holds bodies that have touched beyond d = 0, down to -PairConstants::pull_off_gap or
///                      less. It then knows them by `touched` > 0, the root of their last contact radius;
///     yields           whether it deforms for good. It then knows `touched` as the plastic overlap of the last step
///     [m],
///                      and gives that of this step in `NormalForce::plastic`;
///     set(pair, grains, share)   its own constants, with `share` of its attraction (1 between grains); those of
///                      elasticity and size are there;
///     at(k, sqrt_radius, overlap, touched)   the `NormalForce` of a pair; sqrt_radius is sqrt(R*), radius R*;
///     energy(k, radius, force, overlap)   what it holds [J], 0 out of contact; its derivative by d is the force;
///     surface(k, radius, contact_radius)   if it `adheres`: what attracts has given for the patch [J]; with it,
///                      `energy` is that of the strain;
///     yielded(k, radius, before, after, middle)   if it `yields`: work [J] that a change of the plastic overlap takes
///                      at the overlap `middle`;
///     spent(k, radius)   if it `reaches`: energy it is short of as contact begins, the work to part it [J];
///     widening(k, radius, energy, inverse_contact_radius)   energy (da/dd)/a: force of a spring that grows with a [N];
///     overlap_under(k, radius, load)   d > 0 at which the force is `load` >= 0 [m];
///     collision_time(k, radius, mass, speed)   of a collision at that speed, for the choice of the step [s].
/// The last two, and `set`, are computed once and in plain numbers; the others in packs too (laws/pack.h).
/// To add one: core/README.md.

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
