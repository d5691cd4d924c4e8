#pragma once

#include <array>
#include <chrono>
#include <string_view>

namespace pastefit {

/// Time spent in each stage of the steps [s], for benchmarks; enabled in `StepOptions`. Requirement: one thread.
struct StageClock {
  enum Stage { list, choice, pair, bridge, wall, move, stages };
  static constexpr std::array<std::string_view, stages> names{"list", "select", "pair", "bridge", "wall", "move"};
  std::array<double, stages> seconds{};
};

/// Adds the time until the end of the scope to a stage; does nothing without a clock.
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
