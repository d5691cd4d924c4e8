#pragma once

#include "core/apparatus/slump/ruler.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/step/energy_balance.h"
#include "core/world/world.h"

namespace pastefit {

/// Step 2 of the slump test: the plate is raised, and let go; and all drops after it.
///
/// The top of a heap is never level after step 1, by luck, and most of that tilt (0.75 to 0.9 of it) is still there
/// after the drop of a hinged plate. So the heap is dropped twice, with the hinge on one side and on the opposite one,
/// and readings are means: the tilt goes out of the sag whatever share of it is left, and the sag's noise falls to a
/// third. A table that falls upright has no sides: its heap is dropped once.
///
/// With several drops the heap of the first side goes on: raised and dropped again, at rest in between or until the
/// rhythm of the test is over. Their readings are "after_drops."; the curve is the spread after each drop.
///
/// `world`: the heap at rest, the plate as its wall `table`. `ruler`: that of its step 1.
/// `before`: the energy balance of step 1, which the drops go on with.
Outcome drop_plate(const SlumpTest& test, const World& world, const Ruler& ruler, const EnergyBalance& before,
                   const RunOptions& options);

}  // namespace pastefit
