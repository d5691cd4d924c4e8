#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/result.h"
#include "core/rigs/slump/slump_test.h"

namespace pastefit {

/// The test as JSON, complete and in SI, the unit in each key: the canonical form for cards and stored evaluations.
/// The same test gives the same text (keys sorted, doubles written so that they read back bit for bit).
/// Requirement: every number is finite.
nlohmann::json to_json(const SlumpTable& test);

/// The part of a JSON value that differs from the usual one: of an object its members that do, each likewise; whole
/// lists and numbers. Two values with the same part of the same usual value are the same. What names a test by it gives
/// no other name to it when a field is added that has its usual value there.
nlohmann::json differing_part(const nlohmann::json& value, const nlohmann::json& usual);

/// Reads what `to_json` writes; every key must be there.
/// Errors: every fault of form, or else every fault that `validate` finds; places are paths in the JSON.
Result<SlumpTable> slump_table_from_json(const nlohmann::json& json);

}  // namespace pastefit
