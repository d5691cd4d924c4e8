#pragma once

#include <nlohmann/json_fwd.hpp>

#include "calibrate/report/findings.h"

namespace pastefit {

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

}  // namespace pastefit
