#pragma once

#include <optional>

namespace pastefit {

struct KernelTable;
struct StageClock;

/// How steps are taken.
struct StepOptions {
  std::optional<double> fixed_step_s;  ///< empty: the step follows from stiffness, impacts and bridges
  double safety = 0.8;                 ///< share of the stable step
  double impact_resolution = 10;       ///< steps in the shortest Hertz collision that loses all its energy
  double bridge_resolution = 10;       ///< steps in which the fastest grain crosses a bridge
  double overlap_limit = 0.5;          ///< largest overlap over the smaller radius; beyond it the run is invalid
  double skin = 0.8;                   ///< skin of the candidate list over the mean radius
  int threads = 1;                     ///< that share the work of a step; the bits do not depend on it
  /// Energy is accounted for (core/step/energy_balance.h), and a run that makes or loses some of it fails. Without: the
  /// same motion, bit for bit, and only the other kinds of failure are seen.
  bool energy_balance = true;
  const KernelTable* kernels = nullptr;  ///< empty: the widest this processor runs
  StageClock* clock = nullptr;           ///< what the stages of a step take; with one thread only
};

/// When a specimen counts as at rest: the root mean square speed of its grains is below a bound, and no length of its
/// rest measure (`Runner`) has changed by more than a share of a radius, in so many windows in a row. A stiff heap
/// swings for long like a jelly; that moves no reading by more than these bounds.
struct RestCriterion {
  double window_s = 0.05;
  int windows = 2;
  double speed_over_fall = 0.03;     ///< bound on the speed over sqrt(g R)
  double change_over_radius = 0.02;  ///< bound on the changes over the mean radius
};

}  // namespace pastefit
