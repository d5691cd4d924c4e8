#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/apparatus/impact/impact.h"
#include "core/result.h"

namespace pastefit {

class ObjectReader;

/// Reads the fields of an impact (schema: `impact` in data/schema/case.schema.json) into `test`; faults go to the
/// reader's. `duration_contacts` gives the duration in Hertz collisions of the first grain and its partner: the second
/// grain, or the first wall. The `reference_radius_m` is the first grain's unless it is given.
void read_impact(ObjectReader& reader, Impact& test);

/// A file's content ("format": "pastefit-impact-1") as an impact that can be run. Errors: every fault with its place.
Result<Impact> impact_from_json(const nlohmann::json& document);

}  // namespace pastefit
