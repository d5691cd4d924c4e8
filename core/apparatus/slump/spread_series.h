#pragma once

#include <optional>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/step/run.h"

namespace pastefit {

class World;

/// Whether somebody asks how the heap spreads with time.
bool is_timed(const SlumpTest& test);

/// The spread of a heap against time, from the beginning of the lift: the mean width of its body (`widths`), taken
/// every 10 ms of simulated time. A pure observer: the heap's bits are the same without it.
class SpreadSeries {
 public:
  /// Before each step of step 1.
  void take(const World& world, double mean_radius);

  /// When the spread first was this wide [s], linear between two points; nothing if it never was.
  std::optional<double> time_to(double width_m) const;

  /// When the flow stopped [s]: when the spread last was below 99 % of what it is at the end; 0 if it never was.
  double time_of_flow() const;

  /// Root mean square difference from a measured curve, over its points [m]; after the end the spread is what it was
  /// then. Requirement: something was taken.
  double rms_difference(const std::vector<SpreadPoint>& measured) const;

  /// Seconds and millimetres, at multiples of 10 ms.
  Curve curve() const;

  /// Whether it can be the series of a run, when it was read.
  bool is_sound() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(start_, points_);
  }

 private:
  double at(double time_s) const;

  double start_ = -1;               ///< of the lift [s]; below 0: it has not begun
  std::vector<CurvePoint> points_;  ///< s after the start, m
};

}  // namespace pastefit
