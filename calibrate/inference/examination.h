#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/inference/inference.h"
#include "calibrate/search/search.h"

namespace pastefit {

/// Why a material is the one that is recommended, for `Inference::recommended_because`.
std::string reason_for(bool confirmed, std::size_t packings);

/// Asks what a finished search leaves open: simulates other materials that may meet the laboratory as well, spread as
/// far apart as can be, each on one fresh packing; then, as long as there are simulations left, those that would be
/// shown as equivalent and that only a prediction speaks for. Then infers. Central differences at the best candidate
/// would cost as much and tell the slopes there only; these runs tell them along the whole family, and whether its
/// members hold. Spends at most `simulations`, and no more than the objective's budget; none after a stop request.
/// Requirement: the calibration's best candidate did not fail. `evidence`: what answers say.
/// The answer depends on what was asked only: a resumed calibration infers the same. Nothing, where no simulation has
/// run to its end.
std::optional<Inference> examine(const std::function<TrainingData(std::span<const Response>)>& evidence,
                                 Objective& objective, const Calibration& calibration, int simulations,
                                 std::uint64_t seed);

/// The same of a study. Requirement: `objective` stores in `store`.
/// `conditions`: what those that nobody states do to the readings.
std::optional<Inference> examine(const Study& study, Objective& objective, const Store& store,
                                 const Calibration& calibration, int simulations, std::uint64_t seed,
                                 const std::vector<ConditionEffect>& conditions = {});

}  // namespace pastefit
