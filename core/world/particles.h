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
  float damping_rate = 0;    ///< sum of c_n/m of its contacts at the last step, over what springs leave of 1 [1/s]
  float spin[3] = {};        ///< angular velocity, at the half step before [rad/s]
  float rounded_radius = 0;  ///< [m]
};

/// What the equations of motion need besides: one cache line, 64 bytes. Hot.
struct alignas(64) Velocity {
  Vec3 linear;                 ///< at the half step before [m/s]
  double inverse_mass = 0;     ///< [1/kg]
  Vec3 angular;                ///< at the half step before [rad/s]
  double inverse_inertia = 0;  ///< of a solid sphere, 2.5/(m r^2) [1/(kg m^2)]
};

/// Sum of the contact forces of a step on a grain: half a cache line, 32 bytes. Hot; zero between steps.
struct alignas(32) Load {
  float force[3] = {};   ///< [N]
  float damping = 0;     ///< sum of c_n of the contacts [N s/m]
  float torque[3] = {};  ///< [N m]
  float stiffness = 0;   ///< sum over the contacts of k, or of 3.5 k_t where larger [N/m]
};

/// The lists of a block are valid while its grains are no farther than `distance` from `from`. 16 bytes. Hot.
struct alignas(16) DisplacementBound {
  float from[3] = {};  ///< [m]
  float distance = 0;  ///< [m]
};

/// Spheres as a structure of arrays, in spatial order. `motion`, `velocity` and `load` have dummies behind the grains,
/// one for each block: far away, without effect, for the padding of contact batches.
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

/// Sets the velocities of a grain.
void set_velocity(Particles& particles, std::int32_t i, const Vec3& linear, const Vec3& angular);

/// Provides this many dummies behind the grains, at least one: blocks that run at the same time need one each.
void provide_dummies(Particles& particles, std::size_t count);

/// Reorders the grains: new place k gets the grain at `order[k]`.
void reorder(Particles& particles, const std::vector<std::int32_t>& order);

}  // namespace pastefit
