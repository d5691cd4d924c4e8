#pragma once

#include <optional>
#include <vector>

#include "core/world/walls.h"

namespace pastefit {

/// A rigid plate that turns freely about its wall's pivot, the axis along y.
struct Rotor {
  double mass_kg = 0;
  double inertia_kg_m2 = 0;  ///< about the pivot
};

/// How a falling plate arrived at its stop.
struct Landing {
  double after_s = 0;        ///< from the beginning of the step in which it did
  double turning_rad_s = 0;  ///< just before
};

/// One step of a plate under its own weight and the load on it: I dw/dt = M_grains + m g x, x the centre's distance
/// from the pivot; positive turning lowers the free edge. The stop is where the plate is level: it is stopped dead
/// there at the end of the step. Without gravity there is no stop.
/// kick: from the half step before to the half step after; dt: the step [s]. Requirement: the shape is a Plate.
std::optional<Landing> turn_freely(const Rotor& rotor, Wall& wall, double gravity, double kick, double dt);

/// A lid that is pressed by a constant force and free to move up and down: a mass, the force, and a dashpot that keeps
/// it from falling faster than a bound,
///     m dv/dt = load + F - c v,   c = |load|/fastest,
/// F what the grains do to it. At rest the grains carry the load, exactly; while the lid moves at v they carry it but
/// for the share v/fastest. The mass is inertia without weight: its weight is part of the load.
///
/// Stable for any dashpot, which is taken at the end of the step, and as far as the grains' own step is, if the mass is
/// no less than that of the grains it touches: a lid on N springs k with N times the mass of a grain swings no faster
/// than a grain on one of them.
struct Servo {
  double load_n = 0;  ///< along z, downwards where it is negative
  double mass_kg = 0;
  double fastest_m_s = 0;  ///< at which the lid moves where nothing resists
};

/// One step of the lid, which is made of these walls: gives all of them the lid's velocity along z, and leaves them
/// what they have along x and y.
/// kick: from the half step before to the half step after [s]. Requirements: positive mass and bound, a load.
void press(const Servo& servo, const std::vector<Wall*>& lid, double kick);

}  // namespace pastefit
