#pragma once

#include <cstdint>
#include <vector>

#include "core/laws/constants.h"
#include "core/laws/materials.h"
#include "core/world/domain.h"
#include "core/world/neighbours.h"
#include "core/world/particles.h"
#include "core/world/walls.h"

namespace pastefit {

inline constexpr double kGravity = 9.81;  ///< [m/s^2], downwards along z

/// State of a scene: grains, walls, their contacts, and the time.
class World {
 public:
  Domain domain;
  Particles particles;
  Pairs pairs;
  std::vector<Wall> walls;
  PairConstants grain_pair;
  NormalLaw normal = NormalLaw::hertz;
  BridgeShape attraction = BridgeShape::none;
  RollingModel rolling = RollingModel::none;
  double reference_radius = 1;  ///< mean radius: grain size that the bridge constants refer to [m]
  double gravity = kGravity;
  double drag = 0;  ///< damping rate of velocities [1/s]; only for phases outside the test

  double time = 0;  ///< [s]
  std::int64_t step = 0;

  AttractionReach reach() const {
    return {grain_pair.formation_gap, grain_pair.rupture_gap, grain_pair.pull_off_gap, reference_radius,
            grain_pair.viscosity > 0};
  }
};

/// Sets the contact laws between grains; walls get theirs from `wall_pair`.
void set_contact_model(World& world, const ContactModel& model, double reference_radius);

/// Rotates all grains by half a turn about the z axis, with their history and that of their contacts: exact. Walls are
/// not rotated; those that touch grains must be symmetric.
void turn_half_round(World& world);

}  // namespace pastefit
