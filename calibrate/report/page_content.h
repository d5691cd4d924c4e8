#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "calibrate/card/card.h"
#include "calibrate/inference/inference.h"
#include "calibrate/report/findings.h"

namespace pastefit {

/// Content of the page without the films' grains (`CodedRecording`), in the format of calibrate/report/page/content.js.
/// Missing findings are null or empty; `missing` gives the reasons. `command`: shell command that recreates the page.
nlohmann::ordered_json page_content(const Findings& findings, const std::string& command);

/// Every stored simulation in order of arrival, for a drawing:
///     {"number", "test", "packing", "values": {...}, "readings": {...}, "misfit", "failure", "ended_early",
///      "sketch", "confirmation", "other_grains"}.
/// values: of the free parameters; without a study, of all that are not default. misfit: error in display units
/// (`ErrorUnit`); omitted if unknown. Members that are false are omitted. ended_early: the error is a lower bound.
/// other_grains: coarse grains, or tests outside the study; without error.
nlohmann::ordered_json search_history(const Findings& findings);

/// Misfit of predicted readings over the two most important parameters, with the others as recommended:
///     {"x", "y", "level", "points", "miss": [row by row], "equivalent": [[x, y], ...], "simulated": [[x, y], ...]};
/// x and y: {"name", "lower", "upper", "scale"}; miss: root of the sum of squares, each in standard deviations of one
/// measurement. Null without inference, or with only one free parameter.
nlohmann::ordered_json misfit_map(const Findings& findings);

/// Predicted change of each measured reading if one free parameter changes and the others stay as recommended:
///     [{"parameter", "from", "to", "changes": {reading: [change, its standard deviation]}}].
/// to: a fifth more, a tenth of the range above 0, or as much less where that is beyond the upper bound. changes: empty
/// where the readings jump. Null without inference.
nlohmann::ordered_json sensitivities(const Findings& findings);

/// Force between two grains of the card's size over their overlap, computed by the engine: the fitted law, those of the
/// equivalent materials, and the other attractions with the same force at touch and rupture gap. [{"name", "role":
/// "fitted" | "equivalent" | "other", "points": [[overlap_um, force_mn], ...]}], attraction negative.
nlohmann::ordered_json law_curves(const Card& card, const std::optional<Inference>& inference);

}  // namespace pastefit
