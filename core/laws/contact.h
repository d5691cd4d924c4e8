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
  Real root_radius;          ///< sqrt(R*)
  Real root_mass;            ///< sqrt(m*)
  Real inverse_mass;         ///< 1/m*
  Real size_scale;           ///< s = 2 R*/R_ref
  Real neighbour_damping;    ///< sum of the damping rates of both bodies at the last step [1/s]
};

/// What a contact remembers.
template <class Real>
struct Memory {
  BasicVec3<Real> slip;  ///< accumulated tangential displacement [m]
  BasicVec3<Real> roll;  ///< accumulated relative rotation across the normal [rad]
  Real contact_radius;   ///< sqrt(R* d) at the last step [m], 0 if the bodies did not touch
  Real bridge;           ///< 1 while a liquid bridge lives, else 0
};

/// What a contact does to body i (body j gets the opposite), and what it means for the time step.
template <class Real>
struct Action {
  Real push;                 ///< repulsion less attraction, along the normal [N]
  BasicVec3<Real> traction;  ///< tangential force on i [N]; its torque is r' n x traction on both bodies
  BasicVec3<Real> moment;    ///< rolling moment on i [N m]
  Real damping;              ///< largest damping coefficient, rotation counted [N s/m]
  Real stiffness;            ///< largest stiffness, rotation counted [N/m]
};

/// A solid sphere's surface is 3.5 times as light as its mass: 1/m + r^2/I with I = 2/5 m r^2.
inline constexpr double kSurfaceLightness = 3.5;

namespace detail {

template <class Real>
PASTEFIT_INLINE BasicVec3<Real> in_plane(const BasicVec3<Real>& a, const BasicVec3<Real>& n) {
  return a - dot(a, n) * n;
}

/// Carries a vector of the contact plane to the plane as it is now: same length, turned with the contact.
template <class Real>
PASTEFIT_INLINE BasicVec3<Real> turned(const BasicVec3<Real>& a, const BasicVec3<Real>& n, Real twist_angle) {
  BasicVec3<Real> b = in_plane(a, n);
  b += twist_angle * cross(n, b);
  return square_root(dot(a, a) / larger(dot(b, b), Real(1e-200))) * b;
}

/// The factor that brings a vector of squared length `square` down to `limit`; 1 if it is not longer.
template <class Real>
PASTEFIT_INLINE Real cap(Real square, Real limit) {
  return select(square > limit * limit, limit / square_root(larger(square, Real(1e-200))), Real(1.0));
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

/// Constant torque mu_r N R* against the relative spin. Near rest it turns into a dashpot that takes at most a quarter
/// of the relative spin in one step: without that the torque's sign would alternate and heat the heap.
struct ConstantTorqueRolling {
  static constexpr bool present = true;
  static constexpr bool elastic = false;
};

/// Force of one contact or bridge for one time step `dt`; updates its memory.
///
/// overlap d > 0: Hertz repulsion 4/3 E* sqrt(R*) d^(3/2), constant cohesion against it, damping
///   2 sqrt(5/6) beta sqrt(S_n m*), Mindlin spring S_t on the slip, Coulomb limit, rolling resistance.
/// gap, bridge alive: attraction F(d). A bridge forms at the formation gap and lives until the rupture gap.
///
/// Damping. Velocities are those of the half step before (leapfrog). With the coefficient c/(1 + c dt/(2 m*)) the decay
/// of a single damped collision is exact to second order in dt; the damping of all other contacts of the two bodies
/// enters the denominator in full, which keeps a grain with many damped contacts stable at any step: with
/// C = sum of c/m over a grain's contacts no grain loses more than its relative velocity within a step.
///
/// Slip is shortened when the contact stiffens (factor min(1, a_old/a), a the contact radius) so that stiffening adds
/// no energy and unloading releases the tangential force with the area, as in Mindlin and Deresiewicz's full theory
/// (Thornton et al. 2013); a spring that keeps its slip gains energy in every rebound.
template <class Attraction, class Rolling, class Real>
PASTEFIT_INLINE Action<Real> act(const PairConstants& k, const Meeting<Real>& m, Memory<Real>& memory, Real dt) {
  const Real zero(0.0), one(1.0);
  const auto touching = m.overlap > zero;
  const Real depth = larger(m.overlap, zero);
  const Real approach = dot(m.velocity, m.normal);

  const Real contact_radius = m.root_radius * square_root(depth);
  const Real stiffness_n = Real(k.normal_stiffness) * contact_radius;
  const Real stiffness_t = Real(k.tangential_ratio) * stiffness_n;
  const Real repulsion = Real(k.hertz) * contact_radius * depth;

  const Real damping_n = Real(k.damping) * square_root(stiffness_n) * m.root_mass;
  const Real damping_t = Real(std::sqrt(k.tangential_ratio)) * damping_n;
  const Real largest_damping = larger(damping_n, Real(kSurfaceLightness) * damping_t);
  const Real others = larger(m.neighbour_damping - largest_damping * m.inverse_mass, zero);
  const Real calm = one + dt * others;
  const Real half_step = Real(0.5) * dt * m.inverse_mass;
  const Real damper_n = damping_n / (calm + half_step * damping_n);
  const Real damper_t = damping_t / (calm + half_step * Real(kSurfaceLightness) * damping_t);

  Action<Real> action;
  const Real cohesion = Real(k.cohesion) * m.size_scale * m.size_scale;
  action.push = select(touching, repulsion + damper_n * approach - cohesion, zero);
  action.stiffness = larger(stiffness_n, Real(kSurfaceLightness) * stiffness_t);
  action.damping = largest_damping;

  if constexpr (Attraction::present) {
    const Real gap = -m.overlap;
    const Real formed = select(gap <= Real(k.formation_gap) * m.size_scale, one, memory.bridge);
    memory.bridge = select(gap <= Real(k.rupture_gap) * m.size_scale, formed, zero);
    const Pull<Real> pull = Attraction::at(k, smaller(m.overlap, zero), m.size_scale);
    const Real alive = select(touching, zero, memory.bridge);
    action.push = action.push - alive * pull.force;
    action.stiffness = larger(action.stiffness, alive * pull.slope);
  }

  const Real total = larger(action.push, zero);
  const Real load = k.friction_of_total ? total : repulsion;

  const Real softened = smaller(one, memory.contact_radius / larger(contact_radius, Real(1e-200)));
  const Real twist_angle = m.twist * dt;
  const BasicVec3<Real> velocity_t = m.velocity - approach * m.normal;
  BasicVec3<Real> slip = softened * detail::turned(memory.slip, m.normal, twist_angle);
  slip += dt * velocity_t;
  const Real limit = Real(k.friction) * load;
  BasicVec3<Real> spring = stiffness_t * slip;
  const Real kept = detail::cap(dot(spring, spring), limit);
  memory.slip = select(touching, kept, zero) * slip;
  const BasicVec3<Real> traction = kept * spring + damper_t * velocity_t;
  action.traction = -(detail::cap(dot(traction, traction), limit) * traction);

  if constexpr (Rolling::present) {
    const Real radius = m.root_radius * m.root_radius;
    const BasicVec3<Real> rolling = detail::in_plane(m.spin, m.normal);
    const Real roll_limit = Real(k.rolling_friction) * load * radius;
    // Inertia of relative rolling about the contact: (1/(I_i + m_i r_i^2) + ...)^-1 is 7/5 m* (2 R*)^2 / 4 for equal
    // grains; the same expression serves all sizes.
    const Real inertia = Real(1.4) * radius * radius / m.inverse_mass;
    if constexpr (Rolling::elastic) {
      const Real lever = Real(k.rolling_friction) * radius;
      const Real stiffness_r = Real(2.25) * stiffness_n * lever * lever;
      BasicVec3<Real> roll = softened * detail::turned(memory.roll, m.normal, twist_angle);
      roll += dt * rolling;
      const BasicVec3<Real> moment = stiffness_r * roll;
      const Real square = dot(moment, moment);
      const Real kept_r = detail::cap(square, roll_limit);
      memory.roll = select(touching, kept_r, zero) * roll;
      const Real dashpot =
          select(square > roll_limit * roll_limit, zero, Real(0.6) * square_root(inertia * stiffness_r) / calm);
      action.moment = -(kept_r * moment + dashpot * rolling);
      action.stiffness = larger(action.stiffness, stiffness_r / (Real(0.4) * radius * radius));
    } else {
      const Real speed = square_root(larger(dot(rolling, rolling), Real(1e-200)));
      const Real resistance = smaller(roll_limit / speed, Real(0.25) * inertia / dt);
      action.moment = -(resistance * rolling);
    }
  } else {
    action.moment = {zero, zero, zero};
  }
  memory.contact_radius = contact_radius;
  return action;
}

}  // namespace pastefit
