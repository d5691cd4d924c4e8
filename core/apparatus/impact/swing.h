#pragma once

#include <cmath>
#include <optional>
#include <vector>

namespace pastefit {

/// How fast a swing about zero dies away, from its first two turning points:
/// ln(|first| / |second|) / (time between them) [1/s]; a turning point is that of the parabola through three samples.
class Swing {
 public:
  /// Samples come evenly spaced in time.
  void add(double time, double value) {
    if (samples_ >= 2 && turns_.size() < 2 && (value - last_.value) * (last_.value - before_.value) < 0)
      note_turn(value);
    before_ = last_;
    last_ = {time, value};
    ++samples_;
  }
  /// Empty: it has not turned twice.
  std::optional<double> decay_rate() const {
    if (turns_.size() < 2) return {};
    return std::log(std::fabs(turns_[0].value / turns_[1].value)) / (turns_[1].time - turns_[0].time);
  }

 private:
  struct Sample {
    double time = 0, value = 0;
  };

  void note_turn(double after) {
    const double slope = 0.5 * (after - before_.value), bend = after - 2 * last_.value + before_.value;
    const double step = last_.time - before_.time;
    turns_.push_back({last_.time - slope / bend * step, last_.value - 0.5 * slope * slope / bend});
  }

  Sample before_, last_;
  int samples_ = 0;
  std::vector<Sample> turns_;
};

}  // namespace pastefit
