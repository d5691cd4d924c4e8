#pragma once

#include <functional>
#include <string>

#include "calibrate/calibrator.h"
#include "calibrate/evaluate/simulation_pool.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "core/result.h"

namespace pastefit {

/// Callbacks during a calibration; each may be empty.
struct CalibrateCallbacks {
  std::function<void(const Progress&)> progress;           ///< of the search
  std::function<void(const EvaluationCounts&)> evaluated;  ///< after each simulation
};

/// Returns the reasons why the study cannot be calibrated on this machine, with places in the study file; empty if it
/// can. `threads`: simulations in parallel; 0: one for each core.
Faults validate(const Study& study, int threads = 0);

/// Calibrates on this machine: a `Calibrator` whose simulations a pool runs. Requirement: the store was opened for this
/// program and the inputs of the study. Errors: those of `validate`, before any simulation; the store cannot write an
/// evaluation. `options` do not affect the card of a completed calibration; an engine other than the default needs its
/// own store. `study_file`: name for the card's provenance.
Result<CalibrationResult> calibrate(const Study& study, Store& store, const PoolOptions& options = {},
                                    const CalibrateCallbacks& callbacks = {}, const std::string& study_file = {});

}  // namespace pastefit
