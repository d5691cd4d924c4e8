#pragma once

#include <filesystem>

namespace pastefit {

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
