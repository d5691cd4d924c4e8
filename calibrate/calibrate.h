#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "calibrate/calibrator.h"
#include "calibrate/laboratory/engine.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "core/result.h"

namespace pastefit {

/// Run-time options. They do not affect the card of a completed calibration.
struct CalibrateOptions {
  std::string study_file = {};              ///< name for the card's provenance
  int threads = 0;                          ///< simulations in parallel; 0: one per core
  double wall_budget_s = 0;                 ///< stop after this time with the best result so far; 0: no limit
  double core_budget_s = 0;                 ///< limit of the processor time summed over all simulations; 0: no limit
  const std::atomic<bool>* stop = nullptr;  ///< set to true on interruption by the user
  Engine engine = {};  ///< simulates the tests; an engine other than the default needs its own store
};

/// Callbacks during a calibration; each may be empty.
struct CalibrateCallbacks {
  std::function<void(const Progress&)> progress;           ///< of the search
  std::function<void(const EvaluationCounts&)> evaluated;  ///< after each simulation, one call at a time
  std::function<void()> pulse;          ///< from time to time during each simulation, from any thread
  RunObserver* run_observer = nullptr;  ///< sees the simulations that run to their end
};

/// Returns the reasons why the study cannot be calibrated on this machine, with places in the study file; empty if it
/// can.
Faults validate(const Study& study, const CalibrateOptions& options);

/// Calibrates on this machine: a `Calibrator` whose simulations a pool runs. Requirement: the store was opened for this
/// program and the inputs of the study. Errors: those of `validate`, before any simulation; the store cannot write an
/// evaluation.
Result<CalibrationResult> calibrate(const Study& study, Store& store, const CalibrateOptions& options = {},
                                    const CalibrateCallbacks& callbacks = {});

}  // namespace pastefit
