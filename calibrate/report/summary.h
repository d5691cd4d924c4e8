#pragma once

#include <string>

#include "calibrate/card/card.h"

namespace pastefit {

/// The card as a person reads it: the fitted numbers in SI and scale-free, measured against simulated, how the search
/// went, and one sentence whether the material meets the laboratory. `findings`: what the data say of the parameters
/// (`calibrate/inference/description.h`), as whole lines; may be empty.
std::string summary_of(const Card& card, const std::string& findings = {});

/// That sentence.
std::string verdict_of(const Card& card);

}  // namespace pastefit
