#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"

namespace pastefit {

/// Parses JSON text; `//` and `/* */` comments are allowed. Appends to `faults`:
/// text that is not JSON (with line and column), and keys that stand twice in one object (with the object's place).
/// Returns nothing only if there is no document; twice-given keys are faults, but the document is still read,
/// so that its other faults can be named too. Nesting beyond 32 levels counts as "not JSON".
std::optional<nlohmann::json> parse_json(std::string_view text, Faults& faults);

/// Reads a file of at most 16 MB with `parse_json`; a file that cannot be read is a fault too.
std::optional<nlohmann::json> read_json(const std::filesystem::path& file, Faults& faults);

/// Whether the document's "format" is the expected one, e.g. "pastefit-lab-1".
/// False only if going on makes no sense: it is no object, or another kind of pastefit file.
bool has_format(const nlohmann::json& document, std::string_view expected, Faults& faults);

/// The value as a fault names it: numbers and texts as they are, "an object", "a list" or "null".
std::string text_of(const nlohmann::json& value);

}  // namespace pastefit
