#pragma once

#include <optional>

#include "core/rigs/pellet_crush/pellet_crush.h"
#include "core/rigs/pour.h"

namespace pastefit {

/// Granules in the die, struck off level and at rest; or why it could not be filled.
struct FilledDie {
  Grains grains;
  RunSummary run;
  std::optional<Failure> failure;
};

/// Fills the die of `test` under its own laws: how densely granules that stick come to lie follows from how much they
/// stick and how fast they arrive. They sink as in a liquid; what lies above the fill height is scraped away.
FilledDie fill_die(const PelletCrush& test, const RunOptions& options);

/// When granules count as at rest: the usual window is for grains of 8 mm, and goes with the time in which one falls by
/// its radius.
RunOptions with_window_of(const PelletCrush& test, RunOptions options);

}  // namespace pastefit
