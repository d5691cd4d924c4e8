#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/rigs/slump_table.h"

namespace pastefit {

/// The slump test that a file stands for: a study (free parameters in the middle of their bounds), a card, a
/// laboratory or a rig file, told apart by "format".
///
/// Each of `settings` is "path=value" and changes the file's content before it is read, so that every check applies.
/// `parameters.NAME=number` sets a parameter of `parameter_kinds` in every kind of file. In a study any other path is
/// one of its laboratory file's, e.g. grains.radius_mm=6. A value that is not JSON is a text.
/// Errors: every fault of the file and of the settings.
Result<SlumpTable> read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings);

}  // namespace pastefit
