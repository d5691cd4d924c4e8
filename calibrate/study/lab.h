#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "calibrate/study/study.h"

namespace pastefit {

/// A laboratory file's content as a `Lab`; `folder` is where the file lies, which is where its preset is looked for.
/// Errors: every fault of the content, each with its place.
Result<Lab> lab_from_json(const nlohmann::json& document, const std::filesystem::path& folder);

}  // namespace pastefit
