#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"

namespace pastefit {

/// Summary of a card: fitted parameters in SI and scale-free, measured against simulated readings, course of the
/// search, and the verdict. `findings`: text on the parameters (`calibrate/inference/description.h`), in whole lines;
/// may be empty.
std::string summary_of(const Card& card, const std::string& findings = {});

/// Sentence whether the material meets the measurements.
std::string verdict_of(const Card& card);

/// Complete text of a card: summary, undetermined parameters, conditions of the fit, provenance, baseline, changes
/// since then, and results of other engines.
std::string text_of(const Card& card);

/// Result of another engine for a test of the card: cost, bias of each reading, and verdict.
std::string further_confirmation_text(const FurtherConfirmation& confirmation);

/// Measurements of a test, in the order of its readings.
std::vector<Measurement> laboratory_measurements(const CardTest& test);

/// Remarks on the runs of a test (`laboratory/test.h`); may be empty.
std::string remarks_on(const CardTest& test);

/// Whether a held-out test was predicted. Requirement: it was judged.
std::string hold_out_in_words(const CardTest& test);

/// Reservations about a card whose readings may be within their tolerances, one clause each, the most serious first:
/// those of all `diagnoses_of`. May be empty.
std::vector<std::string> reservations_on(const Card& card);

}  // namespace pastefit
