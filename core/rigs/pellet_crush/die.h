#pragma once

#include <optional>

#include "core/rigs/pellet_crush/pellet_crush.h"
#include "core/rigs/pour.h"

namespace pastefit {

/// Granules in the die, struck off level and at rest; or why it could not be filled.
struct FilledDie {
  LooseGrains grains;
  RunSummary run;
  std::optional<Failure> failure;
};

/// Fills the die of `test` under its own laws: how densely granules that stick come to lie follows from how much they
/// stick and how fast they arrive. They sink as in a liquid; what lies above the fill height is scraped away.
FilledDie fill_die(const PelletCrush& test, const RunOptions& options);

/// How granules are stepped. When they count as at rest: the usual window is for grains of 8 mm, and goes with the time
/// in which one falls by its radius; a strong pellet swings for long like a jelly, at speeds far below the platen's, so
/// what is slow is three times as fast as usual, and what changes little five times as much. How deep two may overlap:
/// where soft ones are pressed, single ones go deeper than in a heap, and still come back.
RunOptions with_bounds_of(const PelletCrush& test, RunOptions options);

}  // namespace pastefit
