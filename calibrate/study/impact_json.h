#pragma once

#include <nlohmann/json.hpp>

#include "core/apparatus/impact/impact.h"
#include "core/result.h"

namespace pastefit {

class ObjectReader;

/// Reads the fields of an impact (schema: `impact` in data/schema/case.schema.json) into `test`; appends faults to
/// those of the reader. `duration_contacts` is the duration in Hertz collisions of the first grain with the second
/// grain or, without one, the first wall. Default of `reference_radius_m`: the radius of the first grain.
void read_impact(ObjectReader& reader, Impact& test);

/// Parses a file's content ("format": "pastefit-impact-1"). Errors: every fault, with its place.
Result<Impact> impact_from_json(const nlohmann::json& document);

}  // namespace pastefit
