#pragma once

#include <string>

#include "calibrate/cli/status_line.h"
#include "core/step/run.h"

namespace pastefit {

/// Tells where a single simulation is, once it has taken two seconds (`status_line.h`).
///
/// The time that is left is that of the phase: a range from the least to the most that it still takes, at the rate of
/// this phase so far. Of the whole test there is none: a heap rests when it does, and each phase has a pace of its own.
class SignOfLife {
 public:
  SignOfLife() = default;
  ~SignOfLife() { line_.clear(); }
  SignOfLife(const SignOfLife&) = delete;
  SignOfLife& operator=(const SignOfLife&) = delete;

  void show(const Snapshot& snapshot);

 private:
  /// In words; nothing while the phase is too young to know.
  std::string time_left(const Snapshot& snapshot) const;

  StatusLine line_;
  std::string phase_;
  double phase_start_wall_s_ = 0, phase_start_s_ = 0;  // simulated, the second
  double last_s_ = 0;
};

}  // namespace pastefit
