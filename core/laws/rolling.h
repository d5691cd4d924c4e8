#pragma once

#include <array>
#include <string_view>

#include "core/laws/constants.h"
#include "core/laws/contact_kinematics.h"
#include "core/laws/contact_plane.h"

namespace pastefit {

/// A contact as a rolling law sees it.
template <class Real>
struct RollingContact {
  decltype(Real() > Real()) touching;
  BasicVec3<Real> spin;         ///< relative spin across the normal [rad/s]
  detail::Turned<Real> turned;  ///< `ContactHistory::roll`, rotated with the contact if the law `turns`
  Real restored;                ///< factor that restores its length
  Real radius, smaller_radius;  ///< R*, smaller of the two radii [m]
  Real sqrt_mass;               ///< sqrt(m*)
  Real stiffness_n, stiffness_t;
  Real old_stiffness_n;        ///< S_n of the step before [N/m]
  Real softened;               ///< min(1, a_old/a) of the contact radius a
  Real sqrt_impedance;         ///< sqrt(S_n m*)
  Real brake, inverse_brakes;  ///< factors that reduce a dashpot like the normal damper
  Real limit;                  ///< largest moment mu_r N R* [N m]
};

/// Laws of rolling resistance. Each is a type with
///     choice, word   its name in the program and in files;
///     parameters, make(contact, radius, value)   its scale-free parameters and their conversion, as for an attraction
///                    (laws/attraction.h);
///     remembers      true if it uses `ContactHistory::roll`;
///     turns          true if that is a vector of the contact plane, which rotates with the contact;
///     act(k, contact, dt, counted, roll, contact_force)   its moment on body i; its dissipated and stored energy if
///                    energies are `counted`; its part in damping and stiffness; and its new history.
/// To add one: core/README.md.

/// Common to both rolling laws: the coefficient mu_r.
struct RollingFriction {
  static constexpr std::array<std::string_view, 1> parameters{"rolling_friction"};

  template <class Value>
  static void make(ContactModel& contact, double, const Value& value) {
    contact.rolling_friction = value("rolling_friction");
  }
};

struct NoRolling {
  static constexpr RollingModel choice = RollingModel::none;
  static constexpr std::string_view word = "none";
  static constexpr std::array<std::string_view, 0> parameters{};
  static constexpr bool remembers = false, turns = false;

  template <class Value>
  static void make(ContactModel&, double, const Value&) {}
  template <class Real>
  PASTEFIT_INLINE static void act(const ConstantsOf<Real>&, const RollingContact<Real>&, Real, bool, BasicVec3<Real>&,
                                  ContactForce<Real>&) {}
};

/// Elastic-plastic spring and dashpot (EPSD) of Ai et al. 2011: k_r = 2.25 S_n (mu_r R*)^2, moment at most mu_r N R*,
/// dashpot 2 eta sqrt(I_r k_r) with eta = 0.3 while the spring has not yielded. I_r is the inertia of relative rolling
/// about the contact, (1/(I_i + m_i r_i^2) + ...)^-1: 7/5 m* R*^2 for equal grains; this expression is used for all
/// sizes.
///
/// The spring's moment has no potential. It is therefore reduced when the contact stiffens (`softened`): stiffening
/// adds no energy, and unloading reduces the moment with the area.
struct SpringDashpotRolling : RollingFriction {
  static constexpr RollingModel choice = RollingModel::spring_dashpot;
  static constexpr std::string_view word = "spring_dashpot";
  static constexpr bool remembers = true, turns = true;

  template <class Real>
  PASTEFIT_INLINE static void act(const ConstantsOf<Real>& k, const RollingContact<Real>& c, Real dt, bool counted,
                                  BasicVec3<Real>& history, ContactForce<Real>& contact_force) {
    const Real zero(0.0), one(1.0), half(0.5);
    const Real lever = k.rolling_friction * c.radius;
    const Real stiffness = Real(2.25) * c.stiffness_n * lever * lever;
    const BasicVec3<Real> roll = fused(c.softened * c.restored, c.turned.vector, dt * c.spin);
    const Real roll_square = dot(roll, roll);
    const Real moment_square = larger(stiffness * stiffness * roll_square, Real(detail::kFloor));
    const Real kept = detail::cap(moment_square, c.limit);
    const Real kept_stiffness = kept * stiffness;
    history = select(c.touching, kept, zero) * roll;
    const Real dashpot = k.roll_damping * c.sqrt_impedance * c.radius * c.radius * c.brake * c.inverse_brakes;
    const Real braking = select(kept < one, zero, dashpot);
    contact_force.moment = -fused(kept_stiffness, roll, braking * c.spin);
    contact_force.damping = fused(k.spin_damping, c.sqrt_impedance, contact_force.damping);
    contact_force.stiffness = larger(
        contact_force.stiffness, fused(Real(kSurfaceLightness), c.stiffness_t, k.roll_stiffness_share * c.stiffness_n));
    if (!counted) return;
    const Real old_stiffness = Real(2.25) * c.old_stiffness_n * lever * lever;
    const Real old_energy = half * old_stiffness * (c.turned.square + c.turned.lost);
    const Real energy = half * kept_stiffness * kept * roll_square;
    const Real work = half * fused(old_stiffness, dot(c.turned.vector, c.spin), kept_stiffness * dot(roll, c.spin));
    contact_force.dissipation_rolling = fused(dt, fused(braking, dot(c.spin, c.spin), work), old_energy - energy);
    contact_force.stored = contact_force.stored + energy;
  }
};

/// Constant torque mu_r N R* against the relative spin. Near rest it becomes a dashpot: otherwise the torque would
/// alternate in sign and add energy to the heap. In one step the dashpot takes at most a fifth of a grain's spin, a
/// tenth between equal grains, so that all contacts of a grain together stay below twice its spin. It stores its last
/// torque.
struct ConstantTorqueRolling : RollingFriction {
  static constexpr RollingModel choice = RollingModel::constant_torque;
  static constexpr std::string_view word = "constant_torque";
  static constexpr bool remembers = true, turns = false;

  template <class Real>
  PASTEFIT_INLINE static void act(const ConstantsOf<Real>&, const RollingContact<Real>& c, Real dt, bool counted,
                                  BasicVec3<Real>& history, ContactForce<Real>& contact_force) {
    const Real floor(detail::kFloor);
    const Real spin_square = larger(dot(c.spin, c.spin), floor);
    const Real gentle =
        Real(0.08) * c.smaller_radius * c.smaller_radius * c.sqrt_mass * c.sqrt_mass / larger(dt, floor);
    const Real resistance = smaller(c.limit / square_root(spin_square), gentle);
    const BasicVec3<Real> torque = resistance * c.spin;
    contact_force.moment = -torque;
    if (counted) contact_force.dissipation_rolling = Real(0.5) * dt * dot(torque + history, c.spin);
    history = torque;
  }
};

}  // namespace pastefit
