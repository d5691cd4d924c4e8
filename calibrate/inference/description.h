#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/inference/inference.h"

namespace pastefit {

/// Text of an inference: identified parameters and their intervals, unidentified ones, equivalent materials, and what
/// to measure next. Several lines, each with its line break.
std::string describe(const Inference& inference);

/// The same without the table of equivalent materials.
std::string what_is_determined(const Inference& inference);

/// Inference for a card: 95 % intervals with at least one end set by the data, correlations from 0.2 on, and
/// unidentified parameters. Rounded to the precision of the sample.
CardInference card_inference(const Inference& inference);

/// Warning if a study has more free parameters than readings and priors can determine; else empty.
std::string warning_before(int parameters, int priors, const std::vector<std::string>& fitted);

/// "a", "a and b", "a, b and c".
std::string enumerated(const std::vector<std::string>& words);

}  // namespace pastefit
