#pragma once

#include <array>
#include <limits>
#include <vector>

#include "calibrate/laboratory/test.h"

namespace pastefit {

/// Thumbnail of a simulation: a line of about fifty points with three digits.
struct Sketch {
  bool heap = false;  ///< heap outline [mm]; otherwise the test's curve, in its units
  std::vector<std::array<double, 2>> points;
};

class Sketcher {
 public:
  /// Takes a snapshot; cheap, because most are skipped.
  void see(const Test& test, const Snapshot& snapshot);

  /// The test's curve if it has one, otherwise the last outline, also after a failure or an early end. No points if no
  /// outline was taken.
  Sketch sketch(const Outcome& outcome) const;

 private:
  Outline heap_;
  double seen_s_ = -std::numeric_limits<double>::infinity();  // time of the last outline, on the clock of its stage
};

}  // namespace pastefit
