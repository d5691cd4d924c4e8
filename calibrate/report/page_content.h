#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "calibrate/card/card.h"
#include "calibrate/inference/inference.h"
#include "calibrate/report/findings.h"

namespace pastefit {

/// All that the page says, but the grains of its films (`CodedRecording`), as the page's program reads it
/// (calibrate/report/page/content.js). What findings lack is null or empty; `missing` says why.
/// `command`: what makes the page again, for people.
nlohmann::ordered_json page_content(const Findings& findings, const std::string& command);

/// Every stored simulation in the order of arrival, for a drawing:
///     {"number", "test", "packing", "values": {...}, "readings": {...}, "misfit", "failure", "ended_early",
///      "sketch", "confirmation", "other_grains"}.
/// values: of the free parameters, or of all that are not default if the study is not known. misfit: largest difference
/// of a fitted reading over its tolerance, in the unit of people (`ErrorUnit`); left out if it is not known, as are
/// all that are false. censored: it was worse than that. other_grains: of coarse grains, or of other tests than
/// the study's; its misfit is not said.
nlohmann::ordered_json search_history(const Findings& findings);

/// The misfit of predicted readings over the two parameters that matter most, the others as recommended:
///     {"x", "y", "level", "points", "miss": [row by row], "equivalent": [[x, y], ...], "simulated": [[x, y], ...]};
/// x and y: {"name", "lower", "upper", "scale"}; miss: root of the sum of squares, each in standard deviations of one
/// measurement. Null if there is no inference, or only one parameter is free.
nlohmann::ordered_json misfit_map(const Findings& findings);

/// The force between two grains of the card's size against their overlap, as the engine computes it: the fitted law,
/// those of the equivalent materials, and the other attractions with the same force at touch and rupture gap.
/// [{"name", "role": "fitted" | "equivalent" | "other", "points": [[overlap_um, force_mn], ...]}], attraction negative.
nlohmann::ordered_json law_curves(const Card& card, const std::optional<Inference>& inference);

}  // namespace pastefit
