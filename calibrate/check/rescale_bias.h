#pragma once

#include "calibrate/check/check.h"

namespace pastefit {

/// Measures what carrying a card to another grain size does to its readings: `before` and `after` (`rescaled(before)`)
/// are both simulated in `packings` random packings each. The answer is `after` with the bias of every reading and its
/// standard error, with readings, confirmation and baseline of its own.
/// Requirement: packings >= 2. Errors: a simulation fails.
Result<Card> with_measured_bias(const Card& before, Card after, int packings, const CheckOptions& options,
                                const CheckEngine& engine = CheckEngine::ours());

}  // namespace pastefit
