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

/// The grains that a test starts from.
struct Packing;

/// How an interrupted run goes on (core/step/run_checkpoint.h).
class RunCheckpoint;

/// Simulated time that a phase still takes [s].
struct PhaseLeft {
  double least_s = 0, most_s = 0;
};

/// Where a run is, handed to the caller between blocks of steps.
struct Snapshot {
  std::string_view phase;
  double time_s = 0;
  std::int64_t step = 0;
  const World* world = nullptr;
  int drop = 0;  ///< which of the drops of one heap it belongs to, from 0
  PhaseLeft left{};
};

/// Values of a reading, in its unit, beyond which the rest of a test is of no use to the caller.
struct Cutoff {
  std::string reading;
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

inline constexpr std::int64_t kStepsPerPulse = 64;

/// What the caller may ask of a run besides its answer.
struct RunOptions {
  StepOptions steps;  ///< with a fixed step, if wanted, instead of the one the scene asks for
  RestCriterion rest;
  std::optional<double> fixed_wait_s;    ///< every wait for rest lasts so long; nobody looks whether rest is reached
  bool own_fill = false;                 ///< pour under the laws of the test, not under those that fills share
  std::int64_t step_limit = 20'000'000;  ///< a run beyond it fails with `step_limit`
  double watch_interval_s = 0.01;        ///< simulated time between two calls of `watch`
  std::function<bool(const Snapshot&)> watch;  ///< called at that interval; returning false stops the run
  /// The same every so many steps, however small these are, for a caller who waits: no more than a moment passes
  /// between.
  std::function<bool(const Snapshot&)> pulse;
  std::shared_ptr<const Packing> packing;     ///< filled mould to start from; empty: the run fills its own
  std::shared_ptr<RunCheckpoint> checkpoint;  ///< given: hands out states of the run, and goes on from one
  /// Given: a run ends as soon as it is certain that the reading will be lower, without any reading of its stage, or
  /// after its stage where it lies beyond; `RunSummary::ended_early` says so. Until then the run is the same, bit for
  /// bit. Which reading may be asked for, and what is certain, is the apparatus's word.
  std::optional<Cutoff> cutoff;
};

/// How the run went.
struct RunSummary {
  std::int64_t particles = 0;
  std::int64_t steps = 0;
  std::int64_t particle_steps = 0;
  double time_step_s = 0;     ///< mean over the run
  double advised_step_s = 0;  ///< smallest step the scene asked for; a fixed step beyond it is not to be trusted
  double simulated_s = 0;
  bool settled = false;      ///< every rest phase ended by its criterion, not by its cap
  bool ended_early = false;  ///< the run left `RunOptions::cutoff`: the later readings were not taken
  std::optional<double>
      energy_error;  ///< unexplained energy over energy put in; none without `StepOptions::energy_balance`
};

struct CurvePoint {
  double x = 0, y = 0;
};

/// What a test draws besides its readings, e.g. stress over strain.
struct Curve {
  std::string name, x, y;  ///< of the curve and its axes, with their units
  std::vector<CurvePoint> points;
};

/// Readings of a run, or the reason why there are none.
struct Outcome {
  Readings readings;
  std::optional<Curve> curve;  ///< of a test that draws one, and came so far
  RunSummary run;
  std::optional<Failure> failure;
};

}  // namespace pastefit
