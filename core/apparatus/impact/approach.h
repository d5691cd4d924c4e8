#pragma once

#include "core/apparatus/impact/impact.h"

namespace pastefit {

/// Two approaching bodies as a contact law sees them: the first grain and a partner.
struct Approach {
  Vec3 normal;          ///< from the grain to the partner
  Vec3 velocity;        ///< of the grain relative to the partner at the contact point, spins included [m/s]
  double speed = 0;     ///< along the normal; positive: they approach [m/s]
  double radius = 0;    ///< R* [m]
  double mass = 0;      ///< m* [kg]; for a rotor its mass is inertia/lever^2
  double modulus = 0;   ///< E* [Pa]
  double friction = 0;  ///< of the pair
  double restitution = 1;
};

/// Grain `i` of the test and grain `j`, or a wall.
Approach approach_of_grains(const Impact& test, std::size_t i, std::size_t j);
Approach approach_of_wall(const Impact& test, std::size_t i, std::size_t wall);

/// Duration of a Hertz collision 2.868 (m*^2/(R* E*^2 v))^(1/5) [s], v the approach speed.
/// The constant is 4 sqrt(pi) Gamma(2/5)/(5 Gamma(9/10)) (15/16)^(2/5).
double hertz_contact_time(const Approach& approach, double speed);

/// Work of the normal law's attraction from touch to zero force [J]; 0 for Hertz.
double drawn_in(const ContactModel& model, const PairConstants& pair, double effective_radius_m);

/// Inertia of a hinged plate [kg m^2]. Requirement: a plate with a rotor mass.
double rotor_inertia(const ImpactWall& wall);

}  // namespace pastefit
