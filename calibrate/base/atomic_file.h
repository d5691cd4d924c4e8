#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/result.h"

namespace pastefit {

/// Type of a path that is not a regular file: "a folder", "a symbolic link", "a device", "a FIFO", "a socket". Empty
/// for regular files and missing paths. Does not follow links.
std::string kind_of_special_file(const std::filesystem::path& path);

/// Replaces a file atomically: writes beside it, syncs, renames. Replaces regular files only: a program that runs as
/// root must not replace a device. Errors, without any change: the path is not a regular file, the folder is not
/// writable, the disk is full.
Faults write_atomically(const std::filesystem::path& file, std::string_view content);

/// Checks that the file can be written: writes `bytes` bytes beside it under an unused name, and removes them. Errors:
/// as `write_atomically`.
Faults probe_beside(const std::filesystem::path& file, std::size_t bytes);

/// Locks a file between processes during the lifetime of the result, so that reading, changing and replacing the file
/// loses no other process's change. Blocks until available. Files that cannot be opened are not locked.
[[nodiscard]] std::shared_ptr<void> locked(const std::filesystem::path& file);

}  // namespace pastefit
