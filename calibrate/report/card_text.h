#pragma once

#include <string>

#include "calibrate/card/card.h"

namespace pastefit {

/// All a card says, for a person: the summary, what the readings leave open, the conditions it was fitted in, where it
/// comes from, its baseline and what was done to it since.
std::string text_of(const Card& card);

}  // namespace pastefit
