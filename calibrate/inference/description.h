#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/inference/inference.h"

namespace pastefit {

/// The inference as text: what is determined and how well, what is not, the equivalent materials, and what to measure
/// next. Several lines, each with its line break.
std::string describe(const Inference& inference);

/// The same without the table of equivalent materials.
std::string what_is_determined(const Inference& inference);

/// The part of it that a card keeps: 95 % intervals that have an end set by the data, how parameters move together
/// (from 0.2 on), and what is not identified. Rounded to the digits that the sample behind them is worth.
CardInference card_inference(const Inference& inference);

/// Warning before a calibration with more free parameters than readings and priors can determine; else empty.
std::string warning_before(int parameters, int priors, const std::vector<std::string>& fitted);

/// "a", "a and b", "a, b and c".
std::string enumerated(const std::vector<std::string>& words);

}  // namespace pastefit
