#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// Free space required by a command: a million exported grains take some 60 MB, a picture of 100,000 some 10 MB.
inline constexpr std::uintmax_t kSpace = 64u << 20;

inline const std::string kStore = "evaluations.sqlite";
/// `names` plus the store's file and those that SQLite keeps beside it.
std::vector<std::string> with_store(std::vector<std::string> names);

enum class EarlierResult { refuse, resume, replace };

/// Output folder, checked before anything runs: it exists, is writable, has space, and is locked for this process
/// during the object's lifetime. Opening changes nothing in it.
class OutputFolder {
 public:
  /// `results`: files that count as an earlier result. `space_bytes`: free space required. Errors: cannot be made or
  /// written, too little space, holds an earlier result (`refuse`), in use by another run.
  static Result<OutputFolder> open(const std::filesystem::path& folder, const std::vector<std::string>& results,
                                   EarlierResult earlier, std::uintmax_t space_bytes);

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  void clear(const std::vector<std::string>& names) const;

 private:
  OutputFolder(std::filesystem::path folder, std::shared_ptr<void> lock)
      : folder_(std::move(folder)), lock_(std::move(lock)) {}
  std::filesystem::path folder_;
  std::shared_ptr<void> lock_;  // its deleter closes the locked folder
};

}  // namespace pastefit
