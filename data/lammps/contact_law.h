#pragma once

#include <string>
#include <vector>

#include "vector.h"

namespace pastefit_lammps {

/// The contact law of a pastefit card: words and numbers as on the card. SI units.
struct Law {
  double reference_radius_m = 0;  ///< grain radius to which forces and lengths of the bridge belong
  double youngs_modulus_pa = 0, poissons_ratio = 0;
  double restitution = 0, friction = 0, rolling_friction = 0;
  std::string rolling;         ///< none, spring_dashpot or constant_torque
  std::string friction_basis;  ///< elastic, total or net
  double cohesion_n = 0;       ///< constant attraction of grains that overlap
  std::string bridge;          ///< none, polynomial, linear, exponential or capillary
  std::string formation;       ///< film or touch
  double a_n_m2 = 0, b_n_m = 0, c_n = 0, d_c_m = 0, offset_m = 0;
  double liquid_volume_m3 = 0, surface_tension_n_m = 0, contact_angle_rad = 0;
  double viscosity_pa_s = 0;     ///< of the liquid of a bridge; may be left out
  std::string normal = "hertz";  ///< hertz, or epa or luding, which need bridge none; may be left out
  double plasticity_ratio = 0, adhesion_ratio = 0;  ///< of epa and luding
};

/// What grains meet at a wall.
struct WallLaw {
  double youngs_modulus_pa = 0, poissons_ratio = 0;
  double restitution = 0, friction = 0, rolling_friction = 0;
  double cohesion_factor = 0;  ///< share of the grains' attraction that acts here
};

/// A plate that turns about a hinge along y.
struct Hinge {
  double mass_kg = 0, inertia_kg_m2 = 0;  ///< inertia about the hinge
  double arm_m = 0;                       ///< of its centre, towards +x when level
  double x_m = 0, z_m = 0;                ///< of the hinge
  double angle_rad = 0;                   ///< at the beginning; negative is raised
};

/// Reads "name value name value ...". Every name has to be there once, but for those of the bridge, whose shape says
/// which it needs. Returns what is wrong, one line for each fault; empty: nothing.
std::string read_law(const std::vector<std::string>& words, Law& law);
std::string read_wall_law(const std::vector<std::string>& words, WallLaw& wall);
std::string read_hinge(const std::vector<std::string>& words, Hinge& hinge);

/// What a contact remembers; numbers only, because it travels between processors as such.
struct ContactHistory {
  Vector slip;                ///< tangential displacement [m]
  Vector roll;                ///< relative rotation across the normal [rad]
  double contact_radius = 0;  ///< at the last step [m]; 0: the bodies did not touch
  double bridge = 0;          ///< 1 while a liquid bridge lives; of epa and luding the plastic overlap [m]

  static constexpr int size = 8;  ///< numbers
  bool empty() const { return contact_radius == 0 && bridge == 0; }
  /// The same contact seen from the other body.
  ContactHistory turned() const { return {-1.0 * slip, -1.0 * roll, contact_radius, bridge}; }
};
static_assert(sizeof(ContactHistory) == ContactHistory::size * sizeof(double));

/// Two bodies seen from their contact; i is a grain, j a grain or a wall.
struct ContactKinematics {
  Vector normal;       ///< unit vector from i to j
  double overlap = 0;  ///< > 0 bodies interpenetrate, < 0 a gap [m]
  Vector velocity;     ///< of i relative to j at the contact, spins included [m/s]
  Vector spin;         ///< of i less that of j [rad/s]
  double twist = 0;    ///< mean spin about the normal [rad/s]
  double radius = 0;   ///< effective, R*
  double mass = 0;     ///< effective, m*
  double smaller_radius = 0;
};

/// On body i; body j gets the opposite. The torque of the tangential force is lever * normal x tangential force on
/// both.
struct ContactForce {
  Vector force;             ///< [N]
  Vector tangential_force;  ///< tangential part of it [N]
  Vector moment;            ///< rolling resistance [N m]
};

/// A law between two surfaces: forces and history of one contact.
class Contact {
 public:
  Contact() = default;
  /// Grain on grain; on a wall, which carries no liquid shell of its own.
  explicit Contact(const Law& law);
  Contact(const Law& law, const WallLaw& wall);

  /// Gap at which a bridge of a pair with this effective radius ruptures [m].
  double reach(double effective_radius) const { return size_scale(effective_radius) * rupture_gap_; }

  /// One step of dt; `advance` is dt, or 0 where time stands still (forces at the beginning of a run).
  ///
  /// Overlap d > 0: Hertz 4/3 E* sqrt(R*) d^1.5 or elasto-plastic adhesion (`press`), constant cohesion against it (to
  /// which the bridge's force at touch passes over within a hundredth of the reference radius), damping 2 sqrt(5/6)
  /// beta sqrt(S_n m*),
  /// Mindlin spring 8 G* sqrt(R* d), which pushes along the normal as its energy grows with the overlap, with the
  /// friction limit on spring and damper together, rolling resistance.
  /// Gap: the bridge's attraction, if it lives. It forms at the formation gap and lives until the rupture gap.
  /// Living bridge of a viscous liquid: lubrication 6 pi mu R* (R*/h) along and 6 pi mu R* (8/15 ln(R*/h) + 0.9588)
  /// across the normal, h the gap but at least 0.02 of the reference radius, also where bodies overlap.
  ContactForce act(const ContactKinematics& kinematics, ContactHistory& history, double dt, double advance) const;

 private:
  void set_elastic(const Law& law, double e, double nu, double restitution);
  void set_friction(double friction);
  void set_plastic(const Law& law, double share);
  void set_attraction(const Law& law, double share, double shells);
  double size_scale(double effective_radius) const { return size_per_radius_ * effective_radius; }
  /// Of bodies that overlap: repulsion less what the law of the overlap itself attracts by, the part of it that
  /// friction feels, and what friction feels besides where it feels the total force [N].
  struct Press {
    double contact_radius, force, load, reserve;
  };
  Press press(const ContactKinematics& kinematics, double scale, ContactHistory& history) const;
  bool yields() const { return normal_ != Normal::hertz; }
  double attraction(double overlap, double scale, ContactHistory& history) const;
  double cohesion(double overlap, double scale) const;
  void lubricate(const ContactKinematics& kinematics, double scale, double dt, const ContactHistory& history,
                 ContactForce& contact_force) const;
  void roll(const ContactKinematics& kinematics, double load, double contact_radius, double braked, double dt,
            double advance, ContactHistory& history, ContactForce& contact_force) const;

  enum class Normal { hertz, epa, luding } normal_ = Normal::hertz;
  enum class Rolling { none, spring_dashpot, constant_torque } rolling_ = Rolling::none;
  enum class Bridge { none, polynomial, exponential, capillary } bridge_ = Bridge::none;
  double size_per_radius_ = 1, hertz_ = 0, normal_stiffness_ = 0, tangential_ratio_ = 0, damping_ = 0;
  double friction_ = 0, slip_limit_ = 0, rolling_friction_ = 0, cohesion_ = 0;
  bool friction_of_total_ = false;
  double friction_reserve_ = 1;  // share of `Press::reserve` that counts as normal force then
  double stiffening_ = 1, adhesion_ = 0, least_plastic_ = 0, most_plastic_ = 1;  // k2/k1, kc/k1, p^m/d^m
  double a_ = 0, b_ = 0, c_ = 0, rupture_gap_ = 0, formation_gap_ = 0, touch_excess_ = 0, passage_ = 1;
  double viscosity_ = 0, roughness_ = 0;
};

}  // namespace pastefit_lammps
