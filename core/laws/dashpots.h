#pragma once

#include "core/laws/constants.h"
#include "core/laws/contact_kinematics.h"
#include "core/laws/contact_plane.h"

namespace pastefit {

/// Stiffnesses and dashpots of a contact of radius a.
template <class Real>
struct Dashpots {
  Real sqrt_contact_radius;       ///< sqrt(a)
  Real inverse_contact_radius;    ///< 1/a, bounded out of contact
  Real stiffness_n, stiffness_t;  ///< S_n = 2 E* a, S_t = 8 G* a [N/m]
  Real sqrt_impedance;            ///< sqrt(S_n m*)
  Real damping_n;                 ///< of the normal dashpot at full strength [N s/m]
  Real damper_n, damper_t;        ///< of both dashpots, as far as stable [N s/m]
  Real brake_t, inverse_brakes;   ///< factors that reduce a dashpot like the normal damper
};

/// Dashpots of a contact for a time step `dt`: 2 sqrt(5/6) beta sqrt(S m*) along and across the normal, reduced as far
/// as the step requires.
///
/// Velocities are those of the previous half step (leapfrog): a damper acts on the velocity dt/2 ago. With c/(1 + c
/// dt/(4 m*)) a pair has its nominal restitution to second order in dt. With many contacts, a mode that loses the share
/// x of its velocity in a step decays too fast, by x/2: a grain among 12 held neighbours by 15 % at the default step
/// (tests/cases/caged-grain.json). A denominator that includes the neighbours would correct this but damp uniform
/// motion too little: with X/12 in it (X as below) pastes spread 0.8 % wider at the default step, without it 0.4 %.
///
/// Explicit damping is stable while no mode loses more than twice its velocity in a step; the springs take (w dt)^2/2
/// of this. X = dt (sum of c_n/m over body i + over body j) bounds the modes along the normals, 2.5 sqrt(S_t/S_n) X
/// those of spins (2.5 = m r^2/I; 3.5 for an isolated pair). A damper is reduced only where this exceeds what the
/// springs leave (`Motion::damping_rate`).
///
/// One division serves all: reductions and contact radius share it.
template <class Real>
PASTEFIT_INLINE Dashpots<Real> dashpots(const ConstantsOf<Real>& k, const ContactKinematics<Real>& m,
                                        Real contact_radius, Real dt) {
  const Real one(1.0), half(0.5), quarter(0.25);
  Dashpots<Real> d;
  d.stiffness_n = k.normal_stiffness * contact_radius;
  d.stiffness_t = k.tangential_ratio * d.stiffness_n;
  d.sqrt_contact_radius = square_root(contact_radius);
  d.sqrt_impedance = k.sqrt_normal_stiffness * m.sqrt_mass * d.sqrt_contact_radius;
  d.damping_n = k.damping * d.sqrt_impedance;
  const Real damping_t = k.tangential_damping * d.sqrt_impedance;
  const Real pair_n = d.damping_n * m.inverse_mass, pair_t = Real(kSurfaceLightness) * damping_t * m.inverse_mass;
  const Real fastest_n = larger(m.neighbour_damping, pair_n);
  const Real fastest_t = larger(k.spin_damping_share * m.neighbour_damping, pair_t);
  const Real brake_n = fused(quarter * dt, pair_n, one) * larger(half * dt * fastest_n, one);
  d.brake_t = fused(quarter * dt, pair_t, one) * larger(half * dt * fastest_t, one);

  const Real brakes = brake_n * d.brake_t, wide = larger(contact_radius, Real(detail::kNoWidth));
  const Real inverse = one / (brakes * wide);
  d.inverse_brakes = inverse * wide;
  d.inverse_contact_radius = inverse * brakes;
  d.damper_n = d.damping_n * d.brake_t * d.inverse_brakes;
  d.damper_t = damping_t * brake_n * d.inverse_brakes;
  return d;
}

}  // namespace pastefit
