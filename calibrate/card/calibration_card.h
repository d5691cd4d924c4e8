#pragma once

#include <string>

#include "calibrate/card/card.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/search/search.h"
#include "calibrate/store/store.h"

namespace pastefit {

/// Response that a card reports: the confirmation, or the best candidate if there is none.
const Response& shown_of(const Calibration& calibration);

/// Card of a finished calibration, with the stored readings of `shown_of`; simulates nothing. `study_file`: name for
/// the provenance. Requirement: the best candidate did not fail. The material is stated for the grains of the study's
/// first test. A held-out test is judged by the noise of both sides (Welch, `base/statistics.h`), with a probability of
/// 0.05 to reject a correct prediction.
Card card_of(const Study& study, const Calibration& calibration, const Store& store, const EvaluationCounts& counts,
             const std::string& study_file);

}  // namespace pastefit
