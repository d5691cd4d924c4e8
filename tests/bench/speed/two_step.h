#pragma once

#include <filesystem>

#include "core/apparatus/slump/slump_test.h"
#include "tests/bench/speed/peers.h"
#include "tests/bench/speed/scene.h"

namespace pastefit {

/// The scene `test`: both steps of EN 12350-5 with about 1,250 cohesive grains of 8 mm (the material of the slump
/// scenes in scale-free numbers, E 2 MPa), from a filled mould to the second height.
SlumpTest two_step_test();

/// Its filled mould. Throws std::runtime_error if it cannot be filled.
Bed fill_two_step();

/// What a two-step test answered.
struct TestAnswer {
  double seconds = 0;  ///< of the processor, from the filled mould to the answer
  double step1_height_mm = 0, step2_height_mm = 0;
};

/// Our test from a filled mould, as anybody would call it. Throws std::runtime_error if it fails.
TestAnswer answer_ours(const Bed& fill);

/// A step at which peers are right about this paste: a tenth of its grains' Rayleigh time [s]. Their customary fifth
/// makes them flow that should stand, without a warning.
double peer_test_step(const Bed& fill);

/// What the decks `test` want besides the laws; writes the files they read into `folder`.
/// Peers know no rest: their phases last fixed times, chosen so that the heap is still at the end of each.
Variables test_variables(const Bed& fill, const std::filesystem::path& folder);

}  // namespace pastefit
