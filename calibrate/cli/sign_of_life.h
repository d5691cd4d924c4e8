#pragma once

#include <chrono>
#include <string>

#include "core/step/run.h"

namespace pastefit {

/// Tells on standard error where a single simulation is, once it has taken two seconds: rewritten in place on a
/// terminal, else a line every ten seconds.
///
/// The time that is left is that of the phase: a range from the least to the most that it still takes, at the rate of
/// this phase so far. Of the whole test there is none: a heap rests when it does, and each phase has a pace of its own.
class SignOfLife {
 public:
  SignOfLife();
  ~SignOfLife();
  SignOfLife(const SignOfLife&) = delete;
  SignOfLife& operator=(const SignOfLife&) = delete;

  void show(const Snapshot& snapshot);

 private:
  using Clock = std::chrono::steady_clock;
  /// In words; nothing while the phase is too young to know.
  std::string time_left(const Snapshot& snapshot, Clock::time_point now) const;

  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
  std::string phase_;
  Clock::time_point phase_start_;
  double phase_start_s_ = 0;  // simulated
  double last_s_ = 0;
  bool shown_ = false;
};

}  // namespace pastefit
