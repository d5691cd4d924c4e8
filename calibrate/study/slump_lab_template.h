#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"

namespace pastefit {

/// The commented laboratory file of a slump test on this preset's apparatus, fit to be read as it is: its mould, speed,
/// table and grains, and the readings that are customary with it, each with its usual value and deviation. Of a preset
/// that names none, a height and a spread.
/// Errors: there is no such preset, it is faulty, or it is an apparatus for another test.
Result<std::string> slump_lab_template(const std::string& preset, const std::filesystem::path& folder);

}  // namespace pastefit
