#pragma once

#include <cstdint>
#include <string>

#include "tests/stability/stress_case.h"

namespace pastefit {

/// How a run of the campaign ended.
struct StressVerdict {
  std::string end;      ///< "valid", the name of a failure's reason, or "defect"
  std::string phase;    ///< of a failure
  std::string message;  ///< of a failure, or what is wrong
  std::int64_t particles = 0, steps = 0;
  double simulated_s = 0, cpu_s = 0, energy_error = 0;
  bool settled = false;
  double height1_mm = 0, height2_mm = 0, spread_mm = 0;  ///< of a valid run
};

/// Bounds of a run.
struct Bounds {
  std::int64_t steps = 200'000;  ///< beyond: a failure `step_limit`
  double cpu_s = 20;             ///< beyond: the caller stops the run, a failure `stopped`
};

/// Runs the case and judges its end. A defect is: faults in an admissible test, an exception, readings that are absent,
/// not finite or out of their physical range without a failure, energy created without a failure (or with one, of a
/// case that `keeps_energy`), grains that vanish or pass a wall without a failure, a failure without phase or message.
StressVerdict judge(const StressCase& stress, const Bounds& bounds);

}  // namespace pastefit
