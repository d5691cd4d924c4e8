#pragma once

#include <string>

#include "calibrate/card/card.h"
#include "calibrate/search/evaluator.h"
#include "calibrate/search/search.h"

namespace pastefit {

/// Simulates the confirmed material in the tests that are held out, on the packings of its confirmation, which the
/// search had not seen: after it, so that they cannot have been fitted. None if the confirmation was not reached.
void predict_hold_outs(const Study& study, const Calibration& calibration, SimulationObjective& objective);

/// What that costs, to be kept back from the search.
int hold_out_simulations(const Study& study, const SearchOptions& options);

/// The card of a finished calibration. Readings that the laboratory did not take, and hold-outs, come from the store.
/// Its material is stated for the grains of the study's first test. A hold-out is judged by the noise of both sides
/// (Welch, `base/statistics.h`), with a probability of 0.05 to call a right prediction wrong.
/// `options`: what the search ran with. `study_file`: name for the provenance.
/// Requirement: the best candidate did not fail.
Card card_of(const Study& study, const Calibration& calibration, const SearchOptions& options, const Store& store,
             const EvaluationCounts& counts, const std::string& study_file);

}  // namespace pastefit
