#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace pastefit {

/// What a contact reads of a grain: one cache line, 64 bytes. Hot. Velocities are those of `Velocity`, rounded.
struct alignas(64) Motion {
  Vec3 position;             ///< [m]
  double radius = 0;         ///< [m]
  float velocity[3] = {};    ///< at the half step before `position` [m/s]
  float damping_rate = 0;    ///< of its contacts at the last step: sum of c_n/m over what springs leave of 1 [1/s]
  float spin[3] = {};        ///< angular velocity, at the half step before [rad/s]
  float rounded_radius = 0;  ///< [m]
};

/// What its equations of motion need besides: one cache line, 64 bytes. Hot.
struct alignas(64) Velocity {
  Vec3 linear;                 ///< at the half step before [m/s]
  double inverse_mass = 0;     ///< [1/kg]
  Vec3 angular;                ///< at the half step before [rad/s]
  double inverse_inertia = 0;  ///< of a solid sphere, 2.5/(m r^2) [1/(kg m^2)]
};

/// What the contacts of a step add up to on a grain: half a cache line, 32 bytes. Hot; zero between steps.
struct alignas(32) Load {
  float force[3] = {};   ///< [N]
  float damping = 0;     ///< sum of c_n of the contacts [N s/m]
  float torque[3] = {};  ///< [N m]
  float stiffness = 0;   ///< sum of k, 3.5 k_t of the contacts [N/m]
};

/// Where a grain may be while the lists of its block hold: no farther from here than this. 16 bytes. Hot.
struct alignas(16) DisplacementBound {
  float from[3] = {};  ///< [m]
  float distance = 0;  ///< [m]
};

/// Spheres as a structure of arrays, kept in spatial order. One more element than grains: the last one is a dummy far
/// away with no mass effect, on which the padding of contact batches acts.
struct Particles {
  std::vector<Motion> motion;
  std::vector<Velocity> velocity;
  std::vector<Load> load;
  std::vector<std::int32_t> identity;  ///< unchanged when grains are sorted
  double density_kg_m3 = 0;

  std::int32_t count() const { return static_cast<std::int32_t>(identity.size()); }
  double mass(std::int32_t i) const { return 1 / velocity[i].inverse_mass; }
};

/// Grains at rest with these centres and radii; identities are 0 .. n-1.
Particles make_particles(const std::vector<Vec3>& centres, const std::vector<double>& radii, double density_kg_m3);

/// Lets a grain move with these velocities.
void set_velocity(Particles& particles, std::int32_t i, const Vec3& linear, const Vec3& angular);

/// Leaves so many dummies behind the grains, at least one: blocks that are worked on at the same time need one each.
void provide_dummies(Particles& particles, std::size_t count);

/// Arranges the grains so that new place k holds what was at `order[k]`.
void reorder(Particles& particles, const std::vector<std::int32_t>& order);

}  // namespace pastefit
