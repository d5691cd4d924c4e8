#pragma once

#include "core/apparatus/slump/slump_test.h"
#include "core/step/energy_balance.h"
#include "core/world/world.h"

namespace pastefit {

/// Tilts the table with the heap of step 1 on it, as an inclined plate test does, about its edge at x = -length/2 and
/// at a constant rate, until the heap slides: until its base, the grains that at first were within a radius of the
/// table, has moved down the table by `Tilt::slide_m` in the mean. The reading is the angle at this moment,
/// `tilt.slide_angle_deg`; a heap that has not slid at `kSteepest` gets this angle. A rigid heap with the Coulomb
/// friction mu of the table and no adhesion slides at atan(mu); at the rate w it has moved by s only after (6 s/(g
/// w))^(1/3), hence a little later.
///
/// `rested`: the heap at rest, with its wall `table`. `before`: the energy balance of step 1, which the tilt continues.
Outcome tilt_table(const SlumpTest& test, const World& rested, const EnergyBalance& before, const RunOptions& options);

}  // namespace pastefit
