#pragma once

#include "core/laws/attraction.h"
#include "core/laws/constants.h"
#include "core/laws/pack.h"
#include "core/vec3.h"

namespace pastefit {

/// Two bodies seen from their contact. Body i is a grain, body j a grain or a wall.
template <class Real>
struct Meeting {
  BasicVec3<Real> normal;    ///< unit vector from i to j
  Real overlap;              ///< d > 0: bodies interpenetrate; d < 0: gap
  BasicVec3<Real> velocity;  ///< of i relative to j at the contact point, spins included
  BasicVec3<Real> spin;      ///< w_i - w_j
  Real twist;                ///< mean spin about the normal: how fast the contact itself turns
  Real smaller_radius;       ///< of the two bodies' radii [m]
  Real root_radius;          ///< sqrt(R*)
  Real root_mass;            ///< sqrt(m*)
  Real inverse_mass;         ///< 1/m*
  Real neighbour_damping;    ///< sum of the damping rates of both bodies at the last step [1/s]
};

/// What a contact remembers.
template <class Real>
struct Memory {
  BasicVec3<Real> slip;  ///< accumulated tangential displacement [m]
  BasicVec3<Real>
      roll;  ///< accumulated relative rotation across the normal [rad]; constant torque: the last torque [N m]
  Real root_contact_radius;  ///< sqrt(a), a = sqrt(R* d), at the last step [m^(1/2)], 0 if the bodies did not touch
  Real damper;               ///< normal damping force at the last step [N]
  Real drag;    ///< coefficient of the tangential damper at the last step, as far as friction let it act [N s/m]
  Real bridge;  ///< 1 while a liquid bridge lives, else 0
};

/// What a contact does to body i (body j gets the opposite), and what it means for the time step.
template <class Real>
struct Action {
  Real push;                 ///< repulsion less attraction, along the normal [N]
  BasicVec3<Real> traction;  ///< tangential force on i [N]; its torque is r' n x traction on both bodies
  BasicVec3<Real> moment;    ///< rolling moment on i [N m]
  Real damping;              ///< damping coefficient along the normal [N s/m]
  // For the ledger: energy turned into heat in this step by each mechanism, and energy stored now [J].
  Real heat_normal, heat_sliding, heat_rolling, heat_bridge, stored;
  Real stiffness;  ///< largest stiffness, rotation counted [N/m]
};

/// How much of a contact's energies is asked for.
enum class Energies {
  none,  ///< nobody keeps a ledger
  heat,  ///< all but the work that living bridges can still do
  all
};

namespace detail {

/// Squared lengths and denominators are kept above this before they are divided by; far below anything in a scene, far
/// above the smallest number, so that a product of four of them is still a number.
inline constexpr double kFloor = 1e-60;

/// A vector of the contact plane on its way to the plane as it is now: projected, turned with the twist; the length it
/// lost by the projection is given back by `restored`.
template <class Real>
struct Turned {
  BasicVec3<Real> vector;
  Real lost;    ///< squared length lost
  Real square;  ///< squared length left
};

template <class Real>
PASTEFIT_INLINE Turned<Real> turned(const BasicVec3<Real>& a, const BasicVec3<Real>& n, Real twist_angle) {
  const Real along = dot(a, n);
  const BasicVec3<Real> b = fused(-along, n, a);
  return {fused(twist_angle, cross(n, b), b), along * along, larger(dot(b, b), Real(kFloor))};
}

/// sqrt(1 + x) to second order: enough for the few hundredths of a degree a contact turns in a step.
template <class Real>
PASTEFIT_INLINE Real restored(const Turned<Real>& t, Real inverse_square) {
  return fused(Real(0.5) * t.lost, inverse_square, Real(1.0));
}

/// The factor that brings a vector down to `limit`; 1 if it is not longer. Where all contacts of a batch hold, as in a
/// heap at rest, there is nothing to divide.
template <class Real>
PASTEFIT_INLINE Real cap(Real square, Real limit) {
  const auto yields = square > limit * limit;
  if (!any(yields)) return Real(1.0);
  return select(yields, limit / square_root(square), Real(1.0));
}

/// The factor that brings a traction down to what friction allows, mu (load + push factor^2): the spring's own push
/// belongs to the load. Two rounds from below: right to 0.1 % up to mu = 0.5, 4 % low at 1. (From above there is
/// another solution, at which a spring would hold on to a grain that leaves.)
template <class Real>
PASTEFIT_INLINE Real cap(Real square, Real friction, Real load, Real push) {
  const Real one(1.0), least = friction * load;
  if (!any(square > least * least)) return one;
  const Real share = friction / square_root(square);
  Real kept = smaller(share * load, one);
  for (int round = 0; round < 2; ++round) kept = smaller(share * fused(kept * kept, push, load), one);
  return kept;
}

}  // namespace detail

// Rolling resistance: types with `present`, `elastic` (needs memory) and the moment on body i.

struct NoRolling {
  static constexpr bool present = false;
};

/// Elastic-plastic spring and dashpot (EPSD) of Ai et al. 2011: k_r = 2.25 S_n (mu_r R*)^2, moment at most mu_r N R*,
/// dashpot 2 eta sqrt(I_r k_r) with eta = 0.3 while the spring has not yielded.
struct SpringDashpotRolling {
  static constexpr bool present = true;
  static constexpr bool elastic = true;
};

/// Constant torque mu_r N R* against the relative spin. Near rest it turns into a dashpot: without that the torque's
/// sign would alternate and heat the heap. In one step a dashpot takes at most a fifth of a grain's spin, a tenth among
/// equal grains, so that all the contacts of a grain together stay below twice of it.
struct ConstantTorqueRolling {
  static constexpr bool present = true;
  static constexpr bool elastic = false;
};

/// Force of one contact or bridge for one time step `dt`; updates its memory. Energies that are not asked for are
/// zero; the force does not depend on what is.
///
/// overlap d > 0: Hertz repulsion 4/3 E* sqrt(R*) d^(3/2), constant cohesion against it, damping
///   2 sqrt(5/6) beta sqrt(S_n m*), Mindlin spring S_t on the slip, Coulomb limit on spring and damper together,
///   rolling resistance.
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
/// The tangential spring is T = S_t s with S_t = 8 G* sqrt(R* d), as Mindlin's without slip inside the contact. It
/// holds the energy U = S_t s^2/2, which grows with the overlap; its derivative U/(2 d) acts along the normal. Without
/// that part a contact that is pressed while it is stretched would make energy (5 % in a collision); with it none is
/// made or lost but by friction. The spring alone holds no more than mu times the repulsion and its own push, the
/// traction altogether no more than mu times the load (`friction_of_total`) and that push, which is at most mu^2/5 of
/// the repulsion.
///
/// The rolling spring, whose moment has no potential of its own, is shortened when the contact stiffens (factor
/// min(1, a_old/a), a the contact radius): stiffening adds no energy, and unloading releases the moment with the area.
///
/// Square roots and divisions are what this function costs most: two roots and one division, and a root and a division
/// more for each of sliding and rolling where a contact of the batch yields; what can be divided together is.
template <class Attraction, class Rolling, class Real>
PASTEFIT_INLINE Action<Real> act(const PairConstants& k, const Meeting<Real>& m, Memory<Real>& memory, Real dt,
                                 Energies energies) {
  const Real zero(0.0), one(1.0), half(0.5), floor(detail::kFloor);
  const bool counted = energies != Energies::none;
  const auto touching = m.overlap > zero;
  const Real depth = larger(m.overlap, zero);
  const Real approach = dot(m.velocity, m.normal);

  const Real contact_radius = m.root_radius * square_root(depth);
  const Real stiffness_n = Real(k.normal_stiffness) * contact_radius;
  const Real stiffness_t = Real(k.tangential_ratio) * stiffness_n;
  const Real repulsion = Real(k.hertz) * contact_radius * depth;

  const Real root_contact_radius = square_root(contact_radius);
  const Real root_impedance = Real(k.root_normal_stiffness) * m.root_mass * root_contact_radius;  // sqrt(S_n m*)
  const Real damping_n = Real(k.damping) * root_impedance;
  const Real damping_t = Real(k.tangential_damping) * root_impedance;
  const Real own_n = damping_n * m.inverse_mass, own_t = Real(kSurfaceLightness) * damping_t * m.inverse_mass;
  const Real fastest_n = larger(m.neighbour_damping, own_n);
  const Real fastest_t = larger(Real(k.spin_damping_share) * m.neighbour_damping, own_t);
  const Real brake_n = fused(Real(0.25) * dt, own_n, one) * larger(half * dt * fastest_n, one);
  const Real brake_t = fused(Real(0.25) * dt, own_t, one) * larger(half * dt * fastest_t, one);

  const Real twist_angle = m.twist * dt;
  const auto slip_turned = detail::turned(memory.slip, m.normal, twist_angle);
  detail::Turned<Real> roll_turned{};
  roll_turned.square = one;
  if constexpr (Rolling::present) {
    if constexpr (Rolling::elastic) roll_turned = detail::turned(memory.roll, m.normal, twist_angle);
  }
  const Real brakes = brake_n * brake_t, squares = slip_turned.square * roll_turned.square;
  const Real wide = larger(contact_radius, floor);
  const Real inverse = one / (brakes * squares * wide);
  const Real inverse_brakes = inverse * squares * wide, inverse_squares = inverse * brakes * wide;
  const Real inverse_contact_radius = inverse * brakes * squares;
  const Real old_contact_radius = memory.root_contact_radius * memory.root_contact_radius;
  const Real damper_n = damping_n * brake_t * inverse_brakes;
  const Real damper_t = damping_t * brake_n * inverse_brakes;
  const Real damper = damper_n * approach;

  Action<Real> action;
  const Real radius = m.root_radius * m.root_radius;
  const Real size_scale = Real(k.size_per_radius) * radius;
  const Real cohesion = Real(k.cohesion) * size_scale * size_scale;
  action.push = select(touching, repulsion + damper - cohesion, zero);
  action.stiffness = larger(stiffness_n, Real(kSurfaceLightness) * stiffness_t);
  action.damping = damping_n;
  if constexpr (Rolling::present) {
    if constexpr (Rolling::elastic) action.damping = fused(Real(k.spin_damping), root_impedance, damping_n);
  }
  action.heat_normal = action.heat_sliding = action.heat_rolling = action.heat_bridge = action.stored = zero;
  if (counted) {
    // The damper of a step works along the mean of the velocities before and after it: half of its work is known now,
    // the other half one step later.
    action.heat_normal = half * dt * (damper + memory.damper) * approach;
    memory.damper = damper;
    action.stored = fused(Real(0.4), repulsion, -cohesion) * depth;
  }

  if constexpr (Attraction::present) {
    const Pull<Real> pull = bridge_pull<Attraction>(k, m.overlap, size_scale, memory.bridge, action.heat_bridge);
    if (energies == Energies::all)
      action.stored = fused(-memory.bridge, Attraction::work(k, smaller(m.overlap, zero), size_scale), action.stored);
    action.push = action.push - pull.force;
    action.stiffness = larger(action.stiffness, pull.slope);
  }

  const Real pressed = k.friction_of_total ? larger(action.push, zero) : repulsion;

  const BasicVec3<Real> velocity_t = fused(-approach, m.normal, m.velocity);
  const Real slip_factor = detail::restored(slip_turned, inverse_squares * roll_turned.square);
  const BasicVec3<Real> stretched = fused(slip_factor, slip_turned.vector, dt * velocity_t);
  const Real stretch_square = larger(dot(stretched, stretched), floor);
  const Real held = detail::cap(stretch_square * stiffness_t * stiffness_t, Real(k.slip_limit) * repulsion);
  const BasicVec3<Real> slip = held * stretched;
  const Real trial_energy = half * stiffness_t * held * held * stretch_square;
  const Real trial_push = half * trial_energy * radius * inverse_contact_radius * inverse_contact_radius;
  const BasicVec3<Real> traction = fused(stiffness_t, slip, damper_t * velocity_t);
  const Real traction_square = larger(dot(traction, traction), floor);

  BasicVec3<Real> roll{};
  Real roll_square = zero, moment_square = one, stiffness_r = zero;
  BasicVec3<Real> rolling{};
  if constexpr (Rolling::present) {
    rolling = fused(-dot(m.spin, m.normal), m.normal, m.spin);
    if constexpr (Rolling::elastic) {
      const Real lever = Real(k.rolling_friction) * radius;
      const Real softened = smaller(one, old_contact_radius * inverse_contact_radius);
      const Real roll_factor = softened * detail::restored(roll_turned, inverse_squares * slip_turned.square);
      roll = fused(roll_factor, roll_turned.vector, dt * rolling);
      stiffness_r = Real(2.25) * stiffness_n * lever * lever;
      roll_square = dot(roll, roll);
      moment_square = larger(stiffness_r * stiffness_r * roll_square, floor);
      action.stiffness = larger(
          action.stiffness, fused(Real(kSurfaceLightness), stiffness_t, Real(k.roll_stiffness_share) * stiffness_n));
    } else {
      moment_square = larger(dot(rolling, rolling), floor);
    }
  }
  const Real kept = detail::cap(traction_square, Real(k.friction), pressed, trial_push);
  action.traction = -kept * traction;
  memory.slip = select(touching, kept, zero) * slip;
  const Real slip_energy = kept * kept * trial_energy, slip_push = kept * kept * trial_push;
  action.push = action.push + slip_push;
  const Real roll_limit = Real(k.rolling_friction) * (pressed + slip_push) * radius;
  const Real old_stiffness_n = Real(k.normal_stiffness) * old_contact_radius;
  if (counted) {
    const Real old_stiffness_t = Real(k.tangential_ratio) * old_stiffness_n;
    const Real old_slip_energy = half * old_stiffness_t * (slip_turned.square + slip_turned.lost);
    const Real old_slip_push = half * old_slip_energy * radius / larger(old_contact_radius * old_contact_radius, floor);
    // Work along the mean of the velocities before and after each step, summed by parts: the damper of this step counts
    // for three quarters, that of the last for one; not for more where a contact that held is suddenly torn away.
    const Real drag = kept * damper_t;
    const Real mean_drag = fused(Real(0.75), drag, Real(0.25) * smaller(memory.drag, Real(1.5) * drag));
    memory.drag = drag;
    const Real sliding = dot(velocity_t, velocity_t), back = dot(slip_turned.vector, velocity_t);
    const Real forth = held * fused(slip_factor, back, dt * sliding);  // slip . velocity_t
    const Real spring_work = half * fused(old_stiffness_t, back, kept * stiffness_t * forth);
    const Real push_work = half * (old_slip_push + slip_push) * approach;
    action.heat_sliding = fused(dt, fused(mean_drag, sliding, spring_work + push_work), old_slip_energy - slip_energy);
    action.stored = action.stored + slip_energy;
  }

  if constexpr (Rolling::present) {
    // Inertia of relative rolling about the contact, (1/(I_i + m_i r_i^2) + ...)^-1: 7/5 m* R*^2 for equal grains; the
    // same expression serves all sizes.
    if constexpr (Rolling::elastic) {
      const Real kept_r = detail::cap(moment_square, roll_limit);
      const Real lever = Real(k.rolling_friction) * radius;
      const Real kept_stiffness = kept_r * stiffness_r;
      memory.roll = select(touching, kept_r, zero) * roll;
      // 2 eta sqrt(I_r k_r) with eta = 0.3, braked like the other dampers.
      const Real dashpot = Real(k.roll_damping) * root_impedance * radius * radius * brake_t * inverse_brakes;
      const Real braking = select(kept_r < one, zero, dashpot);
      action.moment = -fused(kept_stiffness, roll, braking * rolling);
      if (counted) {
        const Real old_stiffness_r = Real(2.25) * old_stiffness_n * lever * lever;
        const Real old_roll_energy = half * old_stiffness_r * (roll_turned.square + roll_turned.lost);
        const Real roll_energy = half * kept_stiffness * kept_r * roll_square;
        const Real roll_work =
            half * fused(old_stiffness_r, dot(roll_turned.vector, rolling), kept_stiffness * dot(roll, rolling));
        action.heat_rolling =
            fused(dt, fused(braking, dot(rolling, rolling), roll_work), old_roll_energy - roll_energy);
        action.stored = action.stored + roll_energy;
      }
    } else {
      const Real gentle =
          Real(0.08) * m.smaller_radius * m.smaller_radius * m.root_mass * m.root_mass / larger(dt, floor);
      const Real resistance = smaller(roll_limit / square_root(moment_square), gentle);
      const BasicVec3<Real> torque = resistance * rolling;
      action.moment = -torque;
      if (counted) action.heat_rolling = half * dt * dot(torque + memory.roll, rolling);
      memory.roll = torque;
    }
  } else {
    action.moment = {zero, zero, zero};
  }
  memory.root_contact_radius = root_contact_radius;
  return action;
}

}  // namespace pastefit
