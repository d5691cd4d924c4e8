#pragma once

#include <optional>

namespace pastefit {

struct KernelTable;
struct StageClock;

/// Options of a time step.
struct StepOptions {
  std::optional<double> fixed_step_s;  ///< empty: the step follows from stiffness, impacts, bridges and viscosity
  double safety = 0.8;                 ///< fraction of the stability limit
  double impact_resolution = 10;       ///< steps in the shortest collision that loses all its energy
  double bridge_resolution = 10;       ///< steps in which the fastest grain crosses a bridge
  double overlap_limit = 0.5;          ///< largest overlap over the smaller radius; a larger one fails the run
  double skin = 0.8;                   ///< skin of the neighbour list over the mean radius
  int threads = 1;                     ///< that share the work of a step; no effect on the bits
  /// Keeps the energy balance (core/step/energy_balance.h) and fails a run that creates or loses energy. Without it the
  /// motion is the same, bit for bit, but only the other failures are detected.
  bool energy_balance = true;
  const KernelTable* kernels = nullptr;  ///< empty: the widest that this processor supports
  StageClock* clock = nullptr;           ///< times the stages of a step; one thread only
};

/// A specimen is at rest when the root mean square speed of its grains is below a bound, and no length of its rest
/// measure (`Runner`) changes by more than a share of a radius, in several consecutive windows. A stiff heap oscillates
/// for long; no reading changes by more than these bounds.
struct RestCriterion {
  double window_s = 0.05;
  int windows = 2;
  double speed_over_fall = 0.03;     ///< bound on the speed over sqrt(g R)
  double change_over_radius = 0.02;  ///< bound on the changes over the mean radius
};

}  // namespace pastefit
