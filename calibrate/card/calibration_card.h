#pragma once

#include <string>

#include "calibrate/card/card.h"
#include "calibrate/search/evaluator.h"
#include "calibrate/search/strategy.h"

namespace pastefit {

/// The card of a finished calibration. Readings that the laboratory did not take come from the store.
/// `options`: what the search ran with. `study_file`, `lab_file`: names for the provenance.
/// Requirement: the best candidate did not fail.
Card card_of(const Study& study, const Calibration& calibration, const SearchOptions& options, const Store& store,
             const EvaluationCounts& counts, const std::string& study_file, const std::string& lab_file);

}  // namespace pastefit
