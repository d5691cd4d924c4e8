#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.h"

namespace pastefit {

/// Replaces the file by this content, whole or not at all: written beside it, forced to the disk, renamed over it.
/// Errors: the folder cannot be written or the disk is full; the old file is then as it was.
Faults write_atomically(const std::filesystem::path& file, std::string_view content);

}  // namespace pastefit
