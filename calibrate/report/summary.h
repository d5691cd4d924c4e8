#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"

namespace pastefit {

/// The card as a person reads it: the fitted numbers in SI and scale-free, measured against simulated, how the search
/// went, and one sentence whether the material meets the laboratory. `findings`: what the data say of the parameters
/// (`calibrate/inference/description.h`), as whole lines; may be empty.
std::string summary_of(const Card& card, const std::string& findings = {});

/// That sentence.
std::string verdict_of(const Card& card);

/// All a card says, for a person: the summary, what the readings leave open, the conditions it was fitted in, where it
/// comes from, its baseline, what was done to it since, and what other engines make of it.
std::string text_of(const Card& card);

/// What another engine made of a test of the card: what it cost, the bias of each reading, and the verdict.
std::string further_confirmation_text(const FurtherConfirmation& confirmation);

/// What the laboratory measured in a test, in the order of its readings.
std::vector<Measurement> laboratory_measurements(const CardTest& test);

/// What a person should know of the runs of a test (`laboratory/test.h`); empty: nothing.
std::string remarks_on(const CardTest& test);

/// What speaks against a card although its readings may be within their tolerances, a clause each, the gravest first:
/// heaps that sheared off and whatever else a kind of test remarks on its runs; readings that are within their
/// tolerance only without their standard error; parameters that ended at a bound, or beyond what is plausible. Empty:
/// nothing.
std::vector<std::string> reservations_on(const Card& card);

}  // namespace pastefit
