#pragma once

#include "core/laws/attraction.h"
#include "core/laws/constants.h"
#include "core/laws/contact_kinematics.h"
#include "core/laws/contact_plane.h"
#include "core/laws/dashpots.h"
#include "core/laws/lubrication.h"
#include "core/laws/normal.h"
#include "core/laws/rolling.h"
#include "core/laws/tangential.h"

namespace pastefit {

/// Linear transition from the attraction at touch to the cohesion, over the overlap `passage`. A jump of the force
/// would create energy at any step: a pair that is pulled together by the bridge and not held by the cohesion would
/// oscillate across touch for ever.
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

/// Repulsion, damping and cohesion along the normal. The work of a damper uses the mean of the velocities before and
/// after the step: half of it is known now, the other half one step later.
template <class Normal, class Real>
PASTEFIT_INLINE ContactForce<Real> press(const ConstantsOf<Real>& k, const ContactKinematics<Real>& m, Real approach,
                                         const NormalForce<Real>& normal, const Dashpots<Real>& d, Real size_scale,
                                         Real dt, bool counted, ContactHistory<Real>& history) {
  const Real zero(0.0), half(0.5);
  const Real damper = d.damper_n * approach;
  Real cohesion = k.cohesion * size_scale * size_scale;
  if constexpr (Normal::reaches) cohesion = select(m.overlap > zero, cohesion, zero);  // in gaps the bridge attracts

  ContactForce<Real> contact_force;
  contact_force.normal_force = select(normal.touching, normal.force + damper - cohesion, zero);
  Real stiffness = d.stiffness_n;
  if constexpr (Normal::yields) stiffness = k.stiffening * stiffness;
  contact_force.stiffness = larger(stiffness, Real(kSurfaceLightness) * d.stiffness_t);
  contact_force.damping = d.damping_n;
  contact_force.moment = {zero, zero, zero};
  contact_force.dissipation_normal = contact_force.dissipation_sliding = contact_force.dissipation_rolling =
      contact_force.dissipation_bridge = contact_force.stored = zero;
  if (!counted) return contact_force;
  const Real radius = m.sqrt_radius * m.sqrt_radius;
  contact_force.dissipation_normal = half * dt * (damper + history.damper) * approach;
  history.damper = damper;
  contact_force.stored = fused(-cohesion, larger(m.overlap, zero), Normal::energy(k, radius, normal, m.overlap));
  return contact_force;
}

/// Adds the attraction across a gap and, in overlap, the transition to the cohesion.
template <class Attraction, class Real>
PASTEFIT_INLINE void attract(const ConstantsOf<Real>& k, Real overlap, Real size_scale, Energies energies, Real& bridge,
                             ContactForce<Real>& contact_force) {
  const Pull<Real> pull = bridge_pull<Attraction>(k, overlap, size_scale, bridge, contact_force.dissipation_bridge);
  if (energies == Energies::all)
    contact_force.stored =
        fused(-bridge, Attraction::work(k, smaller(overlap, Real(0.0)), size_scale), contact_force.stored);
  contact_force.normal_force = contact_force.normal_force - pull.force;
  contact_force.stiffness = larger(contact_force.stiffness, pull.slope);
  if (k.passes_over) pass_over(k, overlap, size_scale, energies != Energies::none, contact_force);
}

/// The contact as the rolling law sees it. The spring's moment is reduced when the contact stiffens, by a_old/a.
template <class Rolling, class Real>
PASTEFIT_INLINE RollingContact<Real> rolling_contact(const ConstantsOf<Real>& k, const ContactKinematics<Real>& m,
                                                     const NormalForce<Real>& normal, const Dashpots<Real>& d, Real dt,
                                                     const ContactHistory<Real>& history) {
  const Real one(1.0);
  const Real old_contact_radius = history.sqrt_contact_radius * history.sqrt_contact_radius;
  RollingContact<Real> rolling;
  rolling.touching = normal.touching;
  rolling.spin = fused(-dot(m.spin, m.normal), m.normal, m.spin);
  rolling.turned = {};
  rolling.turned.square = one;
  if constexpr (Rolling::turns) rolling.turned = detail::turned(history.roll, m.normal, m.twist * dt);
  rolling.restored = detail::restored(rolling.turned);
  rolling.radius = m.sqrt_radius * m.sqrt_radius;
  rolling.smaller_radius = m.smaller_radius;
  rolling.sqrt_mass = m.sqrt_mass;
  rolling.stiffness_n = d.stiffness_n;
  rolling.stiffness_t = d.stiffness_t;
  rolling.old_stiffness_n = k.normal_stiffness * old_contact_radius;
  rolling.softened = smaller(one, old_contact_radius * d.inverse_contact_radius);
  rolling.sqrt_impedance = d.sqrt_impedance;
  rolling.brake = d.brake_t;
  rolling.inverse_brakes = d.inverse_brakes;
  return rolling;
}

/// Force of one contact or bridge for one time step `dt`; updates its history. Energies are zero unless requested; the
/// force does not depend on them.
///
/// in contact                force of the overlap (laws/normal.h), dashpots (laws/dashpots.h), Mindlin spring and
///                           Coulomb limit (laws/tangential.h), rolling resistance (laws/rolling.h)
/// overlap d > 0             also cohesion, constant except for the transition to it (`pass_over`)
/// gap, bridge alive         attraction F(d); a bridge forms at the formation gap and lives until the rupture gap
/// bridge alive, `viscous`   also lubrication (laws/lubrication.h)
///
/// Cost is dominated by square roots and divisions: two roots and one division, plus one of each for sliding and for
/// rolling if a contact of the batch yields. Divisions are combined where possible.
template <class Normal, class Attraction, class Rolling, bool viscous, class Real>
PASTEFIT_INLINE ContactForce<Real> act(const ConstantsOf<Real>& k, const ContactKinematics<Real>& m,
                                       ContactHistory<Real>& history, Real dt, Energies energies) {
  const Real zero(0.0);
  const bool counted = energies != Energies::none;
  const Real approach = dot(m.velocity, m.normal);
  const Real radius = m.sqrt_radius * m.sqrt_radius, size_scale = k.size_per_radius * radius;
  const NormalForce<Real> normal =
      Normal::at(k, m.sqrt_radius, m.overlap, Normal::yields ? history.bond : history.sqrt_contact_radius);
  // Before the slow division, which overlaps with it: 1 to 2 % of a slump.
  const detail::Turned<Real> slip = detail::turned(history.slip, m.normal, m.twist * dt);
  const Dashpots<Real> d = dashpots(k, m, normal.contact_radius, dt);

  ContactForce<Real> contact_force = press<Normal>(k, m, approach, normal, d, size_scale, dt, counted, history);
  if constexpr (Attraction::present)
    attract<Attraction>(k, m.overlap, size_scale, energies, history.bond, contact_force);
  if constexpr (Normal::reaches) {
    const Real joined = select(history.sqrt_contact_radius > zero, zero, Normal::spent(k, radius));
    if (counted)
      contact_force.dissipation_bridge = contact_force.dissipation_bridge + select(normal.touching, joined, zero);
  }

  if constexpr (Normal::yields) {
    const Real middle = larger(m.overlap, zero) + larger(fused(-dt, approach, m.overlap), zero);
    if (counted)
      contact_force.dissipation_plastic = Normal::yielded(k, radius, history.bond, normal.plastic, Real(0.5) * middle);
    history.bond = normal.plastic;
  }

  const Real friction_load = k.friction_of_total
                                 ? larger(fused(k.friction_reserve, normal.reserve, contact_force.normal_force), zero)
                                 : normal.load;
  const TangentialContact<Real> tangential{fused(-approach, m.normal, m.velocity), slip, detail::restored(slip), radius,
                                           friction_load};
  const TangentialSpring<Real> spring = slide<Normal>(k, tangential, normal, d, dt, history.slip, contact_force);
  Lubrication<Real> liquid;
  Real viscous_drag;
  if constexpr (viscous) {
    liquid = lubrication(k, m.overlap, radius, size_scale, history.bond, m.inverse_mass, m.neighbour_damping, dt);
    viscous_drag = viscous_before(liquid, spring.kept * d.damper_t, history);
    history.drag = history.drag - viscous_drag;
  }
  if (counted) count_sliding<Normal>(k, tangential, spring, d, approach, dt, history, contact_force);

  RollingContact<Real> rolling = rolling_contact<Rolling>(k, m, normal, d, dt, history);
  rolling.limit = k.rolling_friction * (friction_load + spring.normal_force) * radius;
  Rolling::act(k, rolling, dt, counted, history.roll, contact_force);
  if constexpr (viscous) lubricate(liquid, m, approach, d.damper_n, viscous_drag, dt, counted, history, contact_force);
  history.sqrt_contact_radius = d.sqrt_contact_radius;
  return contact_force;
}

}  // namespace pastefit
