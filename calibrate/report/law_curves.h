#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "calibrate/card/card.h"
#include "calibrate/inference/inference.h"

namespace pastefit {

/// The force between two grains of the card's size against their overlap, as the engine computes it: the fitted law,
/// those of the equivalent materials, and the other attractions with the same force at touch and rupture gap.
/// [{"name", "role": "fitted" | "equivalent" | "other", "points": [[overlap_um, force_mn], ...]}], attraction negative.
nlohmann::ordered_json law_curves(const Card& card, const std::optional<Inference>& inference);

}  // namespace pastefit
