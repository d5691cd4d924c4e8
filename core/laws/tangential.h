#pragma once

#include "core/laws/constants.h"
#include "core/laws/contact_kinematics.h"
#include "core/laws/contact_plane.h"
#include "core/laws/dashpots.h"
#include "core/laws/normal.h"

namespace pastefit {

/// A contact as the sliding law sees it.
template <class Real>
struct TangentialContact {
  BasicVec3<Real> velocity;   ///< tangential [m/s]
  detail::Turned<Real> slip;  ///< of the last step, rotated with the contact
  Real restored;              ///< factor that restores its length
  Real radius;                ///< R* [m]
  Real friction_load;         ///< normal force in the friction limit, without that of the spring [N]
};

/// The tangential spring at the end of a step.
template <class Real>
struct TangentialSpring {
  Real held;          ///< share of the stretched slip within the limit of the spring alone
  Real kept;          ///< share of that within the friction limit
  Real energy;        ///< [J]
  Real normal_force;  ///< derivative of its energy by the overlap [N]
};

/// Mindlin spring and tangential dashpot, limited by Coulomb friction together. Sets the tangential force, adds to the
/// normal force, and updates the slip.
///
/// The spring is T = S_t s with S_t = 8 G* a, as Mindlin's without slip inside the contact. It stores U = S_t s^2/2,
/// which grows with the overlap; the derivative, U/(2 d) for Hertz, acts along the normal. Without this force a
/// stretched contact under increasing load would create energy (5 % in a collision); with it only friction dissipates.
/// The spring alone is limited to mu times the repulsion and its own normal force; the total tangential force is
/// limited to mu times the load (`friction_of_total`) and that normal force, which is at most mu^2/5 of the repulsion.
template <class Normal, class Real>
PASTEFIT_INLINE TangentialSpring<Real> slide(const ConstantsOf<Real>& k, const TangentialContact<Real>& c,
                                             const NormalForce<Real>& normal, const Dashpots<Real>& d, Real dt,
                                             BasicVec3<Real>& slip, ContactForce<Real>& contact_force) {
  const Real floor(detail::kFloor);
  const BasicVec3<Real> stretched = fused(c.restored, c.slip.vector, dt * c.velocity);
  const Real stretch_square = larger(dot(stretched, stretched), floor);
  TangentialSpring<Real> spring;
  spring.held = detail::cap(stretch_square * d.stiffness_t * d.stiffness_t, k.slip_limit * normal.load);
  const BasicVec3<Real> held_slip = spring.held * stretched;
  const Real held_energy = Real(0.5) * d.stiffness_t * spring.held * spring.held * stretch_square;
  const Real held_normal_force = Normal::widening(k, c.radius, held_energy, d.inverse_contact_radius);
  const BasicVec3<Real> force = fused(d.stiffness_t, held_slip, d.damper_t * c.velocity);
  const Real force_square = larger(dot(force, force), floor);

  spring.kept = detail::cap(force_square, k.friction, c.friction_load, held_normal_force);
  spring.energy = spring.kept * spring.kept * held_energy;
  spring.normal_force = spring.kept * spring.kept * held_normal_force;
  slip = select(normal.touching, spring.kept, Real(0.0)) * held_slip;
  contact_force.tangential_force = -spring.kept * force;
  contact_force.normal_force = contact_force.normal_force + spring.normal_force;
  return spring;
}

/// Counts the energy dissipated by spring, dashpot and friction in the step, and the energy stored in the spring.
///
/// Work uses the mean of the velocities before and after each step, summed by parts: the damper of this step counts
/// three quarters, that of the last step one quarter; not more if a sticking contact suddenly separates.
/// `approach`: velocity of approach along the normal [m/s].
template <class Normal, class Real>
PASTEFIT_INLINE void count_sliding(const ConstantsOf<Real>& k, const TangentialContact<Real>& c,
                                   const TangentialSpring<Real>& spring, const Dashpots<Real>& d, Real approach,
                                   Real dt, ContactHistory<Real>& history, ContactForce<Real>& contact_force) {
  const Real one(1.0), half(0.5);
  const Real old_contact_radius = history.sqrt_contact_radius * history.sqrt_contact_radius;
  const Real old_stiffness = k.tangential_ratio * (k.normal_stiffness * old_contact_radius);
  const Real old_energy = half * old_stiffness * (c.slip.square + c.slip.lost);
  const Real old_normal_force =
      Normal::widening(k, c.radius, old_energy, one / larger(old_contact_radius, Real(detail::kNoWidth)));

  const Real drag = spring.kept * d.damper_t;
  const Real mean_drag = fused(Real(0.75), drag, Real(0.25) * smaller(history.drag, Real(1.5) * drag));
  history.drag = drag;
  const Real sliding = dot(c.velocity, c.velocity), back = dot(c.slip.vector, c.velocity);
  const Real forth = spring.held * fused(c.restored, back, dt * sliding);  // slip . velocity
  const Real spring_work = half * fused(old_stiffness, back, spring.kept * d.stiffness_t * forth);
  const Real normal_work = half * (old_normal_force + spring.normal_force) * approach;
  contact_force.dissipation_sliding =
      fused(dt, fused(mean_drag, sliding, spring_work + normal_work), old_energy - spring.energy);
  contact_force.stored = contact_force.stored + spring.energy;
}

}  // namespace pastefit
