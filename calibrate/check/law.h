#pragma once

#include <vector>

#include "calibrate/check/check.h"

namespace pastefit {

/// The attraction of two of the material's grains, of the mean radius, measured in the engine while they are pulled
/// apart slowly, against the formula of the card's law, at five gaps within the reach of the bridge and one beyond it.
/// No noise: the band is 1e-6 of the force at touch, what interpolation between two steps of the pull leaves uncertain.
std::vector<CheckedReading> check_law(const Material& material, const CheckEngine& engine);

}  // namespace pastefit
