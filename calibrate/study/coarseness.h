#pragma once

#include <string>
#include <vector>

#include "calibrate/laboratory/test.h"
#include "calibrate/study/study.h"

namespace pastefit {

// Studies that are met too easily: by grains so few, or tolerances so wide, that a wrong material meets them as well.

/// Fewest grains that stand for a continuum: 83 of them have met the readings of a wrong material.
inline constexpr double kFewGrains = 500;

/// That the apparatus holds fewer, a sentence without a full stop; empty otherwise, and for tests of one body.
std::string note_on_grain_count(const Test& test);

/// Of every fitted reading whose tolerance is beyond three standard deviations, the laboratory's or the published one,
/// whichever is smaller; a sentence without a full stop, which names the number of grains, too.
std::vector<std::string> notes_on_tolerances(const Study& study);

}  // namespace pastefit
