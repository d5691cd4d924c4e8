#pragma once

#include <optional>
#include <vector>

#include "core/world/walls.h"

namespace pastefit {

/// A rigid plate that rotates freely about its wall's pivot, with the axis along y.
struct Rotor {
  double mass_kg = 0;
  double inertia_kg_m2 = 0;  ///< about the pivot
};

/// Arrival of a falling plate at its stop.
struct Landing {
  double after_s = 0;        ///< from the beginning of that step
  double turning_rad_s = 0;  ///< just before the stop
};

/// One step of a plate under its own weight and the load on it: I dw/dt = M_grains + m g x, with x the distance of the
/// centre from the pivot; positive rotation lowers the free edge. The plate stops dead when it is level, at the end of
/// the step. Without gravity there is no stop.
/// kick: from the half step before to the half step after; dt: the step [s]. Requirement: the shape is a Plate.
std::optional<Landing> turn_freely(const Rotor& rotor, Wall& wall, double gravity, double kick, double dt);

/// A lid under a constant force, free to move vertically: a mass, the load, and a dashpot that limits its speed,
///     m dv/dt = load + F - c v,   c = |load|/fastest,
/// with F the force of the grains. At rest the grains carry exactly the load; while the lid moves at v, the dashpot
/// carries the share v/fastest of it. The mass is inertia only: its weight is part of the load.
///
/// The dashpot is implicit (velocity at the end of the step), hence stable. The contacts are as stable as those of the
/// grains if the mass is at least that of the grains in contact with the lid: a lid on N springs k with N times the
/// mass of a grain oscillates no faster than a grain on one spring.
struct Servo {
  double load_n = 0;  ///< along z; negative is downwards
  double mass_kg = 0;
  double fastest_m_s = 0;  ///< speed of the lid without resistance
};

/// One step of a lid that consists of these walls: sets the z velocity of all of them; x and y remain unchanged.
/// kick: from the half step before to the half step after [s]. Requirements: positive mass and bound, nonzero load.
void press(const Servo& servo, const std::vector<Wall*>& lid, double kick);

}  // namespace pastefit
