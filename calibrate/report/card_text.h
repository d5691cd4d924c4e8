#pragma once

#include <string>

#include "calibrate/card/card.h"

namespace pastefit {

/// All a card says, for a person: the summary, what the readings leave open, the conditions it was fitted in, where it
/// comes from, its baseline, what was done to it since, and what other engines make of it.
std::string text_of(const Card& card);

/// What another engine made of a test of the card: what it cost, the bias of each reading, and the verdict.
std::string further_confirmation_text(const FurtherConfirmation& confirmation);

}  // namespace pastefit
