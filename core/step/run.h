#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/observe/readings.h"
#include "core/result.h"
#include "core/step/step_options.h"

namespace pastefit {

class World;

/// The grains at the start of a test.
struct Packing;

/// Resumes an interrupted run (core/step/run_checkpoint.h).
class RunCheckpoint;

/// Remaining simulated time of a phase [s].
struct PhaseLeft {
  double least_s = 0, most_s = 0;
};

/// State of a run, passed to the caller between blocks of steps.
struct Snapshot {
  std::string_view phase;
  double time_s = 0;
  std::int64_t step = 0;
  const World* world = nullptr;
  int drop = 0;  ///< index of the drop of a heap, from 0
  PhaseLeft left{};
};

/// Range of a reading, in its unit, outside which the rest of a test is of no use to the caller.
struct Cutoff {
  std::string reading;
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

inline constexpr std::int64_t kStepsPerPulse = 64;

/// Options of a run.
struct RunOptions {
  StepOptions steps;  ///< with a fixed step, if any, instead of the computed one
  RestCriterion rest;
  std::optional<double> fixed_wait_s;  ///< every wait for rest lasts this long, at rest or not
  bool own_fill = false;  ///< fill the mould under the laws of the test, instead of those that candidates share
  std::int64_t step_limit = 20'000'000;        ///< a longer run fails with `step_limit`
  double watch_interval_s = 0.01;              ///< simulated time between two calls of `watch`
  std::function<bool(const Snapshot&)> watch;  ///< called at that interval; returns false to stop the run
  /// As `watch`, but called every `kStepsPerPulse` steps, for callers that must react quickly even if steps are small.
  std::function<bool(const Snapshot&)> pulse;
  std::shared_ptr<const Packing> packing;     ///< filled mould to start from; empty: the run fills one
  std::shared_ptr<RunCheckpoint> checkpoint;  ///< if given: saves states of the run, and resumes from one
  /// If given, the run ends as soon as the reading is certain to be too low (without the readings of this stage), or
  /// after this stage if the reading is out of range; `RunSummary::ended_early` is then true. Until then the run is the
  /// same, bit for bit. The apparatus defines which reading is allowed and when it is certain.
  std::optional<Cutoff> cutoff;
};

/// Summary of a run.
struct RunSummary {
  std::int64_t particles = 0;
  std::int64_t steps = 0;
  std::int64_t particle_steps = 0;
  double time_step_s = 0;     ///< mean over the run
  double advised_step_s = 0;  ///< smallest computed step; a larger fixed step is unreliable
  double simulated_s = 0;
  bool settled = false;      ///< every rest phase ended by its criterion, not by its time limit
  bool ended_early = false;  ///< outside `RunOptions::cutoff`: later readings were not taken
  std::optional<double>
      energy_error;  ///< unexplained energy over energy put in; empty without `StepOptions::energy_balance`
};

struct CurvePoint {
  double x = 0, y = 0;
};

/// A curve that a test gives besides its readings, e.g. stress over strain.
struct Curve {
  std::string name, x, y;  ///< names of the curve and its axes, with units
  std::vector<CurvePoint> points;
};

/// Readings of a run, or the reason why there are none.
struct Outcome {
  Readings readings;
  std::optional<Curve> curve;  ///< if the test has one, and reached it
  RunSummary run;
  std::optional<Failure> failure;
};

}  // namespace pastefit
