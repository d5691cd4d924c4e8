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

/// What exists: grains, walls, their contacts, and the moment they are at.
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
  double reference_radius = 1;  ///< mean radius: the size the bridge's numbers belong to [m]
  double gravity = kGravity;
  double drag = 0;  ///< share of its velocity a grain loses in a second [1/s]; for phases that are no part of the test

  double time = 0;  ///< [s]
  std::int64_t step = 0;

  AttractionReach reach() const {
    return {grain_pair.formation_gap, grain_pair.rupture_gap, grain_pair.pull_off_gap, reference_radius,
            grain_pair.viscosity > 0};
  }
};

/// Sets the laws of a contact model between grains; walls are given theirs by `wall_pair`.
void set_contact_model(World& world, const ContactModel& model, double reference_radius);

/// Turns all grains half round about the z axis, with what they and their contacts
/// remember: exact. The walls stay; those that touch grains must look the same after the turn.
void turn_half_round(World& world);

}  // namespace pastefit
