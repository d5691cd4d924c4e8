#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/evaluate/evaluator.h"
#include "calibrate/search/search.h"

namespace pastefit {

/// Simulates the confirmed material in the tests that are held out, on the packings of its confirmation, which the
/// search had not seen: after it, so that they cannot have been fitted. None if the confirmation was not reached.
void predict_hold_outs(const Study& study, const Calibration& calibration, SimulationObjective& objective);

/// What that costs, to be kept back from the search.
int hold_out_simulations(const Study& study, const SearchOptions& options);

/// What a card reports of a calibration: the confirmation, or the best candidate where there is none.
const Response& shown_of(const Calibration& calibration);

/// What a candidate read in each test of the study, as the store has it; simulates nothing.
std::vector<Baseline> baselines_of(const Study& study, const Response& candidate, const Store& store);

/// The card of a finished calibration. `baselines`: what `shown_of` read in each test of the study on each of its
/// packings (`baselines_of`); one without runs was not simulated. Its material is stated for the
/// grains of the study's first test. A hold-out is judged by the noise of both sides (Welch, `base/statistics.h`), with
/// a probability of 0.05 to call a right prediction wrong. `options`: what the search ran with. `study_file`: name for
/// the provenance. Requirement: the best candidate did not fail.
Card card_of(const Study& study, const Calibration& calibration, const SearchOptions& options,
             const std::vector<Baseline>& baselines, const EvaluationCounts& counts, const std::string& study_file);

}  // namespace pastefit
