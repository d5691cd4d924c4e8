#pragma once

#include "core/apparatus/granules.h"
#include "core/apparatus/pellet_crush/pellet_crush.h"

namespace pastefit {

/// Granules in the die of `test`, struck off level and at rest; or why it could not be filled.
FilledVessel fill_die(const PelletCrush& test, const RunOptions& options);

}  // namespace pastefit
