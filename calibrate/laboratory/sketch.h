#pragma once

#include <array>
#include <limits>
#include <vector>

#include "calibrate/laboratory/test.h"

namespace pastefit {

/// What came of a simulation at a glance, a line of some fifty points to three digits.
struct Sketch {
  bool heap = false;  ///< from the side [mm]; else the curve that the test draws, in its units
  std::vector<std::array<double, 2>> points;
};

/// Draws the sketch of one simulation.
class Sketcher {
 public:
  /// A moment of the run; cheap, because few are looked at.
  void see(const Test& test, const Snapshot& snapshot);

  /// What was seen last, also of a run that failed or ended early; the curve where the test draws one. Without points
  /// if nothing was seen.
  Sketch sketch(const Outcome& outcome) const;

 private:
  Outline heap_;
  double seen_s_ = -std::numeric_limits<double>::infinity();  // when, on the clock of its stage
};

}  // namespace pastefit
