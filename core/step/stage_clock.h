#pragma once

#include <array>
#include <chrono>
#include <string_view>

namespace pastefit {

/// How long each stage of the steps took [s], for benches; asked for in `StepOptions`.
/// Requirement: one thread.
struct StageClock {
  enum Stage { list, choice, pair, bridge, wall, move, stages };
  static constexpr std::array<std::string_view, stages> names{"list", "select", "pair", "bridge", "wall", "move"};
  std::array<double, stages> seconds{};
};

/// Adds to a stage the time from here to the end of the block; to none if there is no clock.
class Timed {
 public:
  Timed(StageClock* clock, StageClock::Stage stage) : clock_(clock), stage_(stage) {
    if (clock_) start_ = std::chrono::steady_clock::now();
  }
  ~Timed() {
    if (clock_)
      clock_->seconds[stage_] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  StageClock* clock_;
  StageClock::Stage stage_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace pastefit
