#pragma once

#include <string>
#include <vector>

#include "core/laws/constants.h"
#include "core/laws/contact_kinematics.h"

namespace pastefit_lammps {

using pastefit::Vec3;

/// What LAMMPS keeps as three numbers.
inline Vec3 vector(const double* v) {
  return {v[0], v[1], v[2]};
}
inline void add(double* to, const Vec3& a) {
  to[0] += a.x;
  to[1] += a.y;
  to[2] += a.z;
}

/// What a contact remembers; numbers only, because it travels between processors as such.
using History = pastefit::ContactHistory<double>;
inline constexpr int kHistoryNumbers = sizeof(History) / sizeof(double);
inline bool is_empty(const History& history) {
  return history.sqrt_contact_radius == 0 && history.bond == 0;
}
/// The same contact seen from the other body.
inline History turned(History history) {
  history.slip = -history.slip;
  history.roll = -history.roll;
  return history;
}

/// The contact laws of a card: names and numbers of `test.contact`, in SI.
struct Law {
  double reference_radius_m = 0;  ///< grain radius to which forces and lengths of the bridge belong
  pastefit::ContactModel grains;
};

/// A plate that turns about a hinge along y.
struct Hinge {
  double mass_kg = 0, inertia_kg_m2 = 0;  ///< inertia about the hinge
  double arm_m = 0;                       ///< of its centre, towards +x when level
  double x_m = 0, z_m = 0;                ///< of the hinge
  double angle_rad = 0;                   ///< at the beginning; negative is raised
};

/// Read "name value name value ...". Return what is wrong, one line for each fault; empty: nothing.
std::string read_law(const std::vector<std::string>& words, Law& law);
std::string read_wall(const std::vector<std::string>& words, pastefit::WallContact& wall);
std::string read_hinge(const std::vector<std::string>& words, Hinge& hinge);

/// Two bodies seen from their contact, as LAMMPS tells of them; i is a grain, j a grain or a wall.
struct Meeting {
  Vec3 normal;         ///< unit vector from i to j
  double overlap = 0;  ///< > 0 bodies interpenetrate, < 0 a gap [m]
  Vec3 velocity;       ///< of i relative to j at the contact, spins included [m/s]
  Vec3 spin;           ///< of i less that of j [rad/s]
  double twist = 0;    ///< mean spin about the normal [rad/s]
  double radius = 0;   ///< effective, R*
  double mass = 0;     ///< effective, m*
  double smaller_radius = 0;
};

/// On body i; body j gets the opposite. The torque of the tangential force is lever * normal x tangential force on
/// both.
struct Reaction {
  Vec3 force;             ///< [N]
  Vec3 tangential_force;  ///< tangential part of it [N]
  Vec3 moment;            ///< rolling resistance [N m]
};

/// The law between two surfaces: pastefit's own kernel of the laws that were chosen (core/laws/contact.h), on plain
/// doubles. Without pastefit's protection of grains that have many damped contacts, which asks for all contacts of a
/// grain: decks take a tenth of Rayleigh's time as their step.
class Surfaces {
 public:
  Surfaces() = default;
  /// Grain on grain; on a wall, which carries no liquid shell of its own.
  explicit Surfaces(const Law& law);
  Surfaces(const Law& law, const pastefit::WallContact& wall);

  /// Gap beyond which a pair with this effective radius does not know of each other [m].
  double reach(double effective_radius) const;

  /// One step of dt. `stands`: time stands still, as where forces are computed at the beginning of a run; springs are
  /// then as the last step left them.
  Reaction act(const Meeting& meeting, History& history, double dt, bool stands) const;

 private:
  using Kernel = pastefit::ContactForce<double> (*)(const pastefit::PairConstants&,
                                                    const pastefit::ContactKinematics<double>&, History&, double dt);
  Surfaces(const pastefit::ContactModel& grains, const pastefit::PairConstants& pair);

  pastefit::PairConstants pair_;
  Kernel kernel_ = nullptr;
};

}  // namespace pastefit_lammps
