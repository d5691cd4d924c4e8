#pragma once

#include "core/laws/pack.h"
#include "core/vec3.h"

namespace pastefit {

/// Two bodies seen from their contact. Body i is a grain, body j a grain or a wall.
template <class Real>
struct ContactKinematics {
  BasicVec3<Real> normal;    ///< unit vector from i to j
  Real overlap;              ///< d > 0: bodies interpenetrate; d < 0: gap
  BasicVec3<Real> velocity;  ///< of i relative to j at the contact point, spins included
  BasicVec3<Real> spin;      ///< w_i - w_j
  Real twist;                ///< mean spin about the normal: angular velocity of the contact itself
  Real smaller_radius;       ///< of both bodies [m]
  Real sqrt_radius;          ///< sqrt(R*)
  Real sqrt_mass;            ///< sqrt(m*)
  Real inverse_mass;         ///< 1/m*
  Real neighbour_damping;    ///< sum of the damping rates of both bodies at the last step [1/s]
};

/// History of a contact, kept from step to step.
template <class Real>
struct ContactHistory {
  BasicVec3<Real> slip;  ///< accumulated tangential displacement [m]
  BasicVec3<Real>
      roll;  ///< accumulated relative rotation across the normal [rad]; constant torque: the last torque [N m]
  Real sqrt_contact_radius;  ///< sqrt(a), a = sqrt(R* d), at the last step [m^(1/2)]; 0 if not in contact
  Real damper;               ///< normal damping force at the last step, including viscous liquid [N]
  Real drag;                 ///< coefficient of the tangential dampers at the last step, as limited by friction [N s/m]
  Real bond;                 ///< 1 while a liquid bridge lives, else 0; laws that `yield`: plastic overlap [m]
};

/// Action of a contact on body i (body j gets the opposite), and its part in the time step.
template <class Real>
struct ContactForce {
  Real normal_force;                 ///< repulsion minus attraction, along the normal [N]
  BasicVec3<Real> tangential_force;  ///< on i [N]; its torque is r' n x this force on both bodies
  BasicVec3<Real> moment;            ///< rolling moment on i [N m]
  Real damping;                      ///< damping coefficient along the normal [N s/m]
  // Energy balance: energy dissipated in this step by each mechanism, and energy stored now [J].
  Real dissipation_normal, dissipation_sliding, dissipation_rolling, dissipation_bridge, stored;
  Real dissipation_viscous;  ///< set if the liquid is viscous
  Real dissipation_plastic;  ///< set if the normal law `yields`
  Real stiffness;            ///< largest stiffness, including rotation [N/m]
};

/// Which energies of a contact are computed.
enum class Energies {
  none,         ///< no energy balance
  dissipation,  ///< all except the work that living bridges can still do
  all
};

}  // namespace pastefit
