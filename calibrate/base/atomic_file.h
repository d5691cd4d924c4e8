#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.h"

namespace pastefit {

/// What a path names that is no regular file: "a folder", "a symbolic link", "a device", "a FIFO", "a socket"; empty
/// for a regular file, or where there is nothing. A link is not followed.
std::string kind_of_special_file(const std::filesystem::path& path);

/// Replaces the file by this content, whole or not at all: written beside it, forced to the disk, renamed over it.
/// Only a regular file is replaced: a program that runs as root must not turn a device into a file.
/// Errors: something that is no regular file has the name, the folder cannot be written or the disk is full; what was
/// there is then as it was.
Faults write_atomically(const std::filesystem::path& file, std::string_view content);

/// Whether the file could be written: so many bytes are written beside it, under a name that nothing has, and removed.
/// Errors: as `write_atomically`.
Faults probe_beside(const std::filesystem::path& file, std::size_t bytes);

/// Holds a file against other processes that lock it, until it is destroyed: who reads, changes and replaces it in
/// between loses nobody's change. Waits for them. A file that cannot be opened is not held.
class FileLock {
 public:
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace pastefit
