#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/result.h"

namespace pastefit {

/// The version of the card format that this program writes.
inline constexpr int kCardVersion = 5;

/// The document in the form of `kCardVersion`, whatever version it was written in: one step for each version, so that
/// every card ever written stays readable.
///
/// 1 -> 2: a baseline without runs is added. Version 1 kept no readings packing by packing.
/// 2 -> 3: the misfit in mm becomes one without a unit, and each reading gets a tolerance: the `tolerance_mm` of the
/// confirmation for lengths, the laboratory's standard deviation for others.
/// 3 -> 4: one test with further ones beside it becomes a material and a list of tests. What is the same in all tests
/// is said once, of the material.
/// 4 -> 5: the offset over R becomes the formation_ratio, 2 offset/-d_c and at most 1, here at the card's own rupture
/// gap. An offset beyond half the rupture gap acted on nothing and ends there. The offset of touch formation becomes
/// part of the rupture gap that it bounded.
/// To add a version: raise `kCardVersion`, one row in the table of steps, a card of the old version in
/// `tests/calibrate/card/versions`.
/// Errors: it is no card, or of a version this program does not know.
Result<nlohmann::json> upgraded_card(nlohmann::json document);

}  // namespace pastefit
