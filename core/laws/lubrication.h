#pragma once

#include "core/laws/constants.h"
#include "core/laws/contact_kinematics.h"
#include "core/laws/contact_plane.h"
#include "core/laws/pack.h"

namespace pastefit {

/// Viscous resistance of the liquid between two bodies [N s/m]: force = coefficient times relative velocity.
template <class Real>
struct Lubrication {
  Real damper_n, damper_t;  ///< along and across the normal, as far as stable
  Real damping;             ///< sum of both at full strength, for the bound on the dampers of a grain
};

namespace detail {

/// ln x for 1/16 <= x <= 64, to 1e-6. The eighth root is near 1, where ln y = 2 artanh((y - 1)/(y + 1)).
template <class Real>
PASTEFIT_INLINE Real logarithm(Real x) {
  const Real one(1.0), root = square_root(square_root(square_root(x)));
  const Real t = (root - one) / (root + one), square = t * t;
  Real sum(1.0 / 11);
  for (const int n : {9, 7, 5, 3, 1}) sum = fused(sum, square, Real(1.0 / n));
  return Real(16.0) * t * sum;
}

}  // namespace detail

/// Lubrication by the liquid of a living bridge (`alive` 0 or 1), of viscosity mu at a gap h:
///     along the normal   6 pi mu R* (R*/h)                      (Adams & Perchard 1985)
///     across it          6 pi mu R* (8/15 ln(R*/h) + 0.9588)    (Goldman, Cox & Brenner 1967)
/// with R* in both as in Nase, Vargas, Abatan & McCarthy, Powder Technol. 116 (2001) 214, and LIGGGHTS. h is the gap,
/// but at least the roughness, 0.02 of the mean radius, also in overlap. The tangential force acts in the middle of the
/// gap (at a wall's surface), so that rigid rotation of a pair is free. Torques against rolling and twisting, which do
/// not grow with 1/h, are neglected. Friction and lubrication are independent.
///
/// Scale-free: mu is a stress over a rate. Force over R^2 is mu times a function of (v/R)/(d/R) for any size.
///
/// The coefficient is not reduced for the delay of half a step, so that steady flow has the given viscosity. Two bodies
/// lose at most their relative velocity in a step; with many contacts the bound on the sum X of all dampers applies
/// (laws/dashpots.h): where X exceeds 2, each is reduced by X/2. In the first step of a run dt is not known when forces
/// are computed; it is 0 there and the liquid has no effect.
template <class Real>
PASTEFIT_INLINE Lubrication<Real> lubrication(const ConstantsOf<Real>& k, Real overlap, Real radius, Real size_scale,
                                              Real alive, Real inverse_mass, Real neighbour_damping, Real dt) {
  const Real one(1.0), half(0.5);
  const Real gap = larger(-overlap, k.roughness * size_scale);
  const Real narrowness = radius / gap, unit = alive * k.viscosity * radius;
  const Real along = unit * narrowness;
  const Real across = unit * fused(Real(8.0 / 15), detail::logarithm(narrowness), Real(0.9588));
  const Real pair_n = along * inverse_mass, pair_t = Real(kSurfaceLightness) * across * inverse_mass;
  const Real brake_n = larger(dt * larger(half * neighbour_damping, pair_n), one);
  const Real brake_t = larger(dt * larger(half * k.spin_damping_share * neighbour_damping, pair_t), one);
  const auto begun = dt > Real(0.0);
  return {select(begun, along / brake_n, Real(0.0)), select(begun, across / brake_t, Real(0.0)), along + across};
}

/// Adds lubrication to the force of a pair and its dissipation to the energy balance. `before`: the viscous part of the
/// tangential damper of the last step [N s/m]; `damper_n`: the other damping along the normal.
///
/// Work uses the mean of the velocities before and after each step, like that of the dashpots (laws/contact.h,
/// laws/tangential.h): `ContactHistory::damper` and `drag` are sums of both kinds. Dissipation along the normal is
/// divided between them in proportion to the present dampers.
template <class Real>
PASTEFIT_INLINE void lubricate(const Lubrication<Real>& l, const ContactKinematics<Real>& m, Real approach,
                               Real damper_n, Real before, Real dt, bool counted, ContactHistory<Real>& history,
                               ContactForce<Real>& contact_force) {
  const Real half(0.5);
  const BasicVec3<Real> sliding = fused(-approach, m.normal, m.velocity);
  const Real squeezed = l.damper_n * approach;
  contact_force.normal_force = contact_force.normal_force + squeezed;
  contact_force.tangential_force = contact_force.tangential_force - l.damper_t * sliding;
  contact_force.damping = contact_force.damping + l.damping;
  if (!counted) return;
  const Real share = l.damper_n / larger(damper_n + l.damper_n, Real(detail::kFloor));
  const Real along = contact_force.dissipation_normal + half * dt * squeezed * approach;
  const Real across = dt * fused(Real(0.75), l.damper_t, Real(0.25) * before) * dot(sliding, sliding);
  contact_force.dissipation_viscous = fused(share, along, across);
  contact_force.dissipation_normal = along - share * along;
  history.damper = history.damper + squeezed;
  history.drag = history.drag + l.damper_t;
}

/// The viscous part of the tangential damper of the last step: all of it across a gap; in contact the present share,
/// and no more than a steady damper can have dissipated.
template <class Real>
PASTEFIT_INLINE Real viscous_before(const Lubrication<Real>& l, Real drag, const ContactHistory<Real>& history) {
  const Real share = l.damper_t / larger(drag + l.damper_t, Real(detail::kFloor));
  return select(history.sqrt_contact_radius > Real(0.0), smaller(share * history.drag, Real(1.5) * l.damper_t),
                history.drag);
}

}  // namespace pastefit
