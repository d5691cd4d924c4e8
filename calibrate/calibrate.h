#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "calibrate/card/card.h"
#include "calibrate/evaluate/evaluator.h"
#include "calibrate/inference/inference.h"
#include "calibrate/laboratory/engine.h"
#include "calibrate/search/search.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "core/result.h"

namespace pastefit {

/// How a calibration is run; none of it changes the card of one that comes to its end.
struct CalibrateOptions {
  std::string study_file = {};              ///< name for the card's provenance
  int threads = 0;                          ///< simulations at the same time; 0: one for each core
  double wall_budget_s = 0;                 ///< end after this time with the best so far; 0: no end
  double core_budget_s = 0;                 ///< the same for the processor time of all simulations together
  const std::atomic<bool>* stop = nullptr;  ///< becomes true when the user wants to end
  Engine engine = {};                       ///< what simulates; another one than the default has a store of its own
};

/// Who is told how it goes; each may be left empty.
struct CalibrateCallbacks {
  std::function<void(const Progress&)> progress;           ///< of the search
  std::function<void(const EvaluationCounts&)> evaluated;  ///< after each simulation, never two calls at a time
  std::function<void()> pulse;                             ///< now and then during each, from any thread
  RunObserver* run_observer = nullptr;                     ///< of the simulations that are not only tried out
};

/// What a calibration brought.
struct CalibrationResult {
  Calibration search;
  EvaluationCounts counts;
  std::optional<Card> card;            ///< none if no candidate could be simulated
  std::optional<Inference> inference;  ///< none if the laboratory is out of reach, or the user stopped the search
};

/// Everything that keeps the study from being calibrated on this machine, places as in the study file; empty: fit to
/// run.
Faults validate(const Study& study, const CalibrateOptions& options);

/// Calibrates: searches (`search`), predicts the tests that are held out, examines which other materials fit as well,
/// and makes the card. All of it together spends at most `study.search.budget_simulations`. Every simulation is in the
/// store before it is used, and what the store knows is not simulated again, so that a calibration that was stopped
/// goes on where it was. Requirement: the store was opened for this program and the inputs of the study.
/// Errors: what `validate` finds, and then nothing was simulated; the store could not keep
/// an evaluation.
Result<CalibrationResult> calibrate(const Study& study, Store& store, const CalibrateOptions& options = {},
                                    const CalibrateCallbacks& callbacks = {});

}  // namespace pastefit
