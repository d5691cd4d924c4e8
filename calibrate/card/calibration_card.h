#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/search/search.h"

namespace pastefit {

/// Response that a card reports: the confirmation, or the best candidate if there is none.
const Response& shown_of(const Calibration& calibration);

/// Stored readings of a candidate in each test of the study; simulates nothing.
std::vector<Baseline> baselines_of(const Study& study, const Response& candidate, const Store& store);

/// Card of a finished calibration. `baselines`: readings of `shown_of` in each test on each of its packings
/// (`baselines_of`); one without runs was not simulated. `options`: of the search. `study_file`: name for the
/// provenance. Requirement: the best candidate did not fail. The material is stated for the grains of the study's first
/// test. A held-out test is judged by the noise of both sides (Welch, `base/statistics.h`), with a probability of 0.05
/// to reject a correct prediction.
Card card_of(const Study& study, const Calibration& calibration, const SearchOptions& options,
             const std::vector<Baseline>& baselines, const EvaluationCounts& counts, const std::string& study_file);

}  // namespace pastefit
