#pragma once

#include <optional>
#include <string_view>

#include "core/step/runner.h"

namespace pastefit {

inline constexpr double kRestCap = 4.0;  ///< [s] simulated time a heap is allowed for coming to rest

/// Waits until the world is at rest, for the time in which it is moved and `cap_s` more at most (`Runner::settle`); or,
/// if the run was given a fixed wait, for the time in which it is moved and that. `done` ends either.
inline std::optional<Failure> wait(Runner& runner, const RunOptions& options, std::string_view phase, double cap_s,
                                   double moved_s = 0, const std::function<bool(const World&)>& done = {}) {
  return options.fixed_wait_s ? runner.run(phase, moved_s + *options.fixed_wait_s, {}, done)
                              : runner.settle(phase, moved_s + cap_s, done);
}

}  // namespace pastefit
