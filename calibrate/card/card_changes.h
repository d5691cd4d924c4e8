#pragma once

#include <nlohmann/json_fwd.hpp>

#include "calibrate/base/json_reader.h"
#include "calibrate/card/card.h"

namespace pastefit {

/// What was done with a card since its calibration, as its file has it: baselines set anew, other grain sizes, further
/// confirmations, and that it was interpolated. Each key is absent where there is nothing.
void add_changes(nlohmann::ordered_json& out, const Card& card);

/// The inverse. Errors: faults of `reader`, whose object `document` is.
void read_changes(ObjectReader& reader, const nlohmann::json& document, Card& card);

}  // namespace pastefit
