#pragma once

#include <optional>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/step/run.h"

namespace pastefit {

class World;

/// True if a reading needs the spread against time.
bool is_timed(const SlumpTest& test);

/// Spread of a heap against time, from the beginning of the lift: the mean width of its body (`widths`), taken every 10
/// ms of simulated time. Only observes: the heap's bits are the same without it.
class SpreadSeries {
 public:
  /// Call before each step of step 1.
  void take(const World& world, double mean_radius);

  /// First time at this spread [s], interpolated linearly; empty if never reached.
  std::optional<double> time_to(double width_m) const;

  /// End of the flow [s]: the last time with less than 99 % of the final spread; 0 if there is none.
  double time_of_flow() const;

  /// Root mean square difference from a measured curve, over its points [m]; after the end the spread stays at its last
  /// value. Requirement: at least one value was taken.
  double rms_difference(const std::vector<SpreadPoint>& measured) const;

  /// In seconds and millimetres, at multiples of 10 ms.
  Curve curve() const;

  /// True if a series read from a checkpoint is consistent.
  bool is_sound() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(start_, points_);
  }

 private:
  double at(double time_s) const;

  double start_ = -1;               ///< time of the lift's beginning [s]; negative: not yet
  std::vector<CurvePoint> points_;  ///< s after the start, m
};

}  // namespace pastefit
