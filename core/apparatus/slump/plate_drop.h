#pragma once

#include "core/apparatus/slump/ruler.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/step/energy_balance.h"
#include "core/world/world.h"

namespace pastefit {

/// Step 2 of the slump test: the plate is raised and released; then all further drops.
///
/// After step 1 the top of a heap has a random tilt, of which 0.75 to 0.9 remain after the drop of a hinged plate. So
/// the heap is dropped twice, with the hinge on opposite sides, and readings are means of both: the tilt cancels in the
/// sag, and the noise of the sag falls to a third. A table that falls vertically has no sides: its heap is dropped
/// once.
///
/// Further drops continue with the heap of the first side: it is raised and dropped again, at rest or at the period of
/// the test, whichever comes first. Their readings are "after_drops."; the curve is the spread after each drop.
///
/// `world`: the heap at rest, with the plate as its wall `table`. `ruler`: that of step 1.
/// `before`: the energy balance of step 1, which the drops continue.
Outcome drop_plate(const SlumpTest& test, const World& world, const Ruler& ruler, const EnergyBalance& before,
                   const RunOptions& options);

}  // namespace pastefit
