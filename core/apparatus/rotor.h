#pragma once

#include <optional>

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

}  // namespace pastefit
