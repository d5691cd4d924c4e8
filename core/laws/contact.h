#pragma once

#include "core/laws/attraction.h"
#include "core/laws/constants.h"
#include "core/laws/contact_kinematics.h"
#include "core/laws/contact_plane.h"
#include "core/laws/normal.h"
#include "core/laws/rolling.h"

namespace pastefit {

/// The attraction at touch passes over into the cohesion along a straight line, from touch to the overlap `passage`. A
/// force that jumps there would make energy at any step: a pair that the bridge pulls shut and nothing holds shut
/// crosses touch for ever.
template <class Real>
PASTEFIT_INLINE void pass_over(const ConstantsOf<Real>& k, Real overlap, Real size_scale, bool counted,
                               ContactForce<Real>& contact_force) {
  const Real zero(0.0), one(1.0);
  const Real inverse_width = one / (k.passage * size_scale);
  const Real left = larger(one - larger(overlap, zero) * inverse_width, zero);
  const Real excess = k.touch_excess * size_scale * size_scale;
  contact_force.normal_force =
      select(overlap > zero, contact_force.normal_force - left * excess, contact_force.normal_force);
  const Real slope = excess * inverse_width;
  contact_force.stiffness =
      larger(contact_force.stiffness, select(overlap > zero, select(left > zero, slope, zero), zero));
  if (counted) {
    const Real work = Real(0.5) * k.passage * size_scale * excess * (one - left * left);
    contact_force.stored = contact_force.stored - select(overlap > zero, work, zero);
  }
}

/// Force of one contact or bridge for one time step `dt`; updates its history. Energies that are not asked for are
/// zero; the force does not depend on what is.
///
/// in contact: the force of the overlap (laws/normal.h), damping 2 sqrt(5/6) beta sqrt(S_n m*), Mindlin spring S_t on
///   the slip, Coulomb limit on spring and damper together, rolling resistance (laws/rolling.h).
/// overlap d > 0: cohesion besides, constant but for the passage to it (`pass_over`).
/// gap, bridge alive: attraction F(d). A bridge forms at the formation gap and lives until the rupture gap.
///
/// Damping. Velocities are those of the half step before (leapfrog): a damper acts on the velocity of dt/2 ago. With
/// c/(1 + c dt/(4 m*)) a pair has its nominal restitution to second order in dt. Among many contacts a mode that loses
/// the share x of its velocity in a step decays too fast, by x/2: a grain among 12 held neighbours by 15 % at the
/// default step (tests/cases/caged-grain.json). A denominator that knows the neighbours can mend that, but then damps
/// what moves alike too little: with X/12 in it (X as below) pastes spread 0.8 % wider at the default step, without
/// it 0.4 %.
///
/// Explicit damping is stable while no mode loses more than twice its velocity in a step, of which its springs take
/// (w dt)^2/2. X = dt (sum of c_n/m over body i + over body j) bounds the modes along the normals, 2.5 sqrt(S_t/S_n) X
/// those of spins (2.5 = m r^2/I; 3.5 for a pair of its own). Only where that is more than the springs leave
/// (`Motion::damping_rate`) a damper is weakened to it.
///
/// The tangential spring is T = S_t s with S_t = 8 G* a, as Mindlin's without slip inside the contact. It holds the
/// energy U = S_t s^2/2, which grows with the overlap; its derivative, U/(2 d) for Hertz, acts along the normal.
/// Without that part a contact that is pressed while it is stretched would make energy (5 % in a collision); with it
/// none is made or lost but by friction. The spring alone holds no more than mu times the repulsion and its own normal
/// force, the tangential force altogether no more than mu times the load (`friction_of_total`) and that normal force,
/// which is at most mu^2/5 of the repulsion.
///
/// The rolling spring, whose moment has no potential of its own, is shortened when the contact stiffens (factor
/// min(1, a_old/a), a the contact radius): stiffening adds no energy, and unloading releases the moment with the area.
///
/// Square roots and divisions are what this function costs most: two roots and one division, and a root and a division
/// more for each of sliding and rolling where a contact of the batch yields; what can be divided together is.
template <class Normal, class Attraction, class Rolling, class Real>
PASTEFIT_INLINE ContactForce<Real> act(const ConstantsOf<Real>& k, const ContactKinematics<Real>& m,
                                       ContactHistory<Real>& history, Real dt, Energies energies) {
  const Real zero(0.0), one(1.0), half(0.5), floor(detail::kFloor);
  const bool counted = energies != Energies::none;
  const Real approach = dot(m.velocity, m.normal);

  const NormalForce<Real> normal_force = Normal::at(k, m.sqrt_radius, m.overlap, history.sqrt_contact_radius);
  const auto touching = normal_force.touching;
  const Real contact_radius = normal_force.contact_radius;
  const Real stiffness_n = k.normal_stiffness * contact_radius;
  const Real stiffness_t = k.tangential_ratio * stiffness_n;

  const Real sqrt_contact_radius = square_root(contact_radius);
  const Real sqrt_impedance = k.sqrt_normal_stiffness * m.sqrt_mass * sqrt_contact_radius;  // sqrt(S_n m*)
  const Real damping_n = k.damping * sqrt_impedance;
  const Real damping_t = k.tangential_damping * sqrt_impedance;
  const Real own_n = damping_n * m.inverse_mass, own_t = Real(kSurfaceLightness) * damping_t * m.inverse_mass;
  const Real fastest_n = larger(m.neighbour_damping, own_n);
  const Real fastest_t = larger(k.spin_damping_share * m.neighbour_damping, own_t);
  const Real brake_n = fused(Real(0.25) * dt, own_n, one) * larger(half * dt * fastest_n, one);
  const Real brake_t = fused(Real(0.25) * dt, own_t, one) * larger(half * dt * fastest_t, one);

  const Real twist_angle = m.twist * dt;
  const auto slip_turned = detail::turned(history.slip, m.normal, twist_angle);
  detail::Turned<Real> roll_turned{};
  roll_turned.square = one;
  if constexpr (Rolling::turns) roll_turned = detail::turned(history.roll, m.normal, twist_angle);
  const Real brakes = brake_n * brake_t, wide = larger(contact_radius, Real(detail::kNoWidth));
  const Real inverse = one / (brakes * wide);
  const Real inverse_brakes = inverse * wide, inverse_contact_radius = inverse * brakes;
  const Real old_contact_radius = history.sqrt_contact_radius * history.sqrt_contact_radius;
  const Real damper_n = damping_n * brake_t * inverse_brakes;
  const Real damper_t = damping_t * brake_n * inverse_brakes;
  const Real damper = damper_n * approach;

  ContactForce<Real> contact_force;
  const Real radius = m.sqrt_radius * m.sqrt_radius;
  const Real size_scale = k.size_per_radius * radius;
  Real cohesion = k.cohesion * size_scale * size_scale;
  if constexpr (Normal::reaches) cohesion = select(m.overlap > zero, cohesion, zero);  // beyond touch the bridge pulls
  contact_force.normal_force = select(touching, normal_force.force + damper - cohesion, zero);
  contact_force.stiffness = larger(stiffness_n, Real(kSurfaceLightness) * stiffness_t);
  contact_force.damping = damping_n;
  contact_force.moment = {zero, zero, zero};
  contact_force.dissipation_normal = contact_force.dissipation_sliding = contact_force.dissipation_rolling =
      contact_force.dissipation_bridge = contact_force.stored = zero;
  if (counted) {
    // The damper of a step works along the mean of the velocities before and after it: half of its work is known now,
    // the other half one step later.
    contact_force.dissipation_normal = half * dt * (damper + history.damper) * approach;
    history.damper = damper;
    contact_force.stored =
        fused(-cohesion, larger(m.overlap, zero), Normal::energy(k, radius, normal_force, m.overlap));
  }

  if constexpr (Attraction::present) {
    const Pull<Real> pull =
        bridge_pull<Attraction>(k, m.overlap, size_scale, history.bridge, contact_force.dissipation_bridge);
    if (energies == Energies::all)
      contact_force.stored =
          fused(-history.bridge, Attraction::work(k, smaller(m.overlap, zero), size_scale), contact_force.stored);
    contact_force.normal_force = contact_force.normal_force - pull.force;
    contact_force.stiffness = larger(contact_force.stiffness, pull.slope);
    if (k.passes_over) pass_over(k, m.overlap, size_scale, counted, contact_force);
  }

  if constexpr (Normal::reaches) {
    const Real joined = select(history.sqrt_contact_radius > zero, zero, Normal::spent(k, radius));
    if (counted) contact_force.dissipation_bridge = contact_force.dissipation_bridge + select(touching, joined, zero);
  }

  const Real pressed = k.friction_of_total
                           ? larger(fused(k.friction_reserve, normal_force.reserve, contact_force.normal_force), zero)
                           : normal_force.load;

  const BasicVec3<Real> velocity_t = fused(-approach, m.normal, m.velocity);
  const Real slip_factor = detail::restored(slip_turned);
  const BasicVec3<Real> stretched = fused(slip_factor, slip_turned.vector, dt * velocity_t);
  const Real stretch_square = larger(dot(stretched, stretched), floor);
  const Real held = detail::cap(stretch_square * stiffness_t * stiffness_t, k.slip_limit * normal_force.load);
  const BasicVec3<Real> slip = held * stretched;
  const Real trial_energy = half * stiffness_t * held * held * stretch_square;
  const Real trial_push = Normal::widening(k, radius, trial_energy, inverse_contact_radius);
  const BasicVec3<Real> tangential_force = fused(stiffness_t, slip, damper_t * velocity_t);
  const Real tangential_square = larger(dot(tangential_force, tangential_force), floor);

  const Real kept = detail::cap(tangential_square, k.friction, pressed, trial_push);
  contact_force.tangential_force = -kept * tangential_force;
  history.slip = select(touching, kept, zero) * slip;
  const Real slip_energy = kept * kept * trial_energy, slip_normal_force = kept * kept * trial_push;
  contact_force.normal_force = contact_force.normal_force + slip_normal_force;
  const Real old_stiffness_n = k.normal_stiffness * old_contact_radius;
  if (counted) {
    const Real old_stiffness_t = k.tangential_ratio * old_stiffness_n;
    const Real old_slip_energy = half * old_stiffness_t * (slip_turned.square + slip_turned.lost);
    const Real old_slip_push =
        Normal::widening(k, radius, old_slip_energy, one / larger(old_contact_radius, Real(detail::kNoWidth)));
    // Work along the mean of the velocities before and after each step, summed by parts: the damper of this step counts
    // for three quarters, that of the last for one; not for more where a contact that held is suddenly torn away.
    const Real drag = kept * damper_t;
    const Real mean_drag = fused(Real(0.75), drag, Real(0.25) * smaller(history.drag, Real(1.5) * drag));
    history.drag = drag;
    const Real sliding = dot(velocity_t, velocity_t), back = dot(slip_turned.vector, velocity_t);
    const Real forth = held * fused(slip_factor, back, dt * sliding);  // slip . velocity_t
    const Real spring_work = half * fused(old_stiffness_t, back, kept * stiffness_t * forth);
    const Real push_work = half * (old_slip_push + slip_normal_force) * approach;
    contact_force.dissipation_sliding =
        fused(dt, fused(mean_drag, sliding, spring_work + push_work), old_slip_energy - slip_energy);
    contact_force.stored = contact_force.stored + slip_energy;
  }

  RollingContact<Real> rolling;
  rolling.touching = touching;
  rolling.spin = fused(-dot(m.spin, m.normal), m.normal, m.spin);
  rolling.turned = roll_turned;
  rolling.restored = detail::restored(roll_turned);
  rolling.radius = radius;
  rolling.smaller_radius = m.smaller_radius;
  rolling.sqrt_mass = m.sqrt_mass;
  rolling.stiffness_n = stiffness_n;
  rolling.stiffness_t = stiffness_t;
  rolling.old_stiffness_n = old_stiffness_n;
  rolling.softened = smaller(one, old_contact_radius * inverse_contact_radius);
  rolling.sqrt_impedance = sqrt_impedance;
  rolling.brake = brake_t;
  rolling.inverse_brakes = inverse_brakes;
  rolling.limit = k.rolling_friction * (pressed + slip_normal_force) * radius;
  Rolling::act(k, rolling, dt, counted, history.roll, contact_force);
  history.sqrt_contact_radius = sqrt_contact_radius;
  return contact_force;
}

}  // namespace pastefit
