#pragma once

#include "core/rigs/granules.h"
#include "core/rigs/pellet_crush/pellet_crush.h"

namespace pastefit {

/// Granules in the die of `test`, struck off level and at rest; or why it could not be filled.
FilledVessel fill_die(const PelletCrush& test, const RunOptions& options);

}  // namespace pastefit
