#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
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

  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&& other) noexcept;
  ~OutputFolder();

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  void clear(const std::vector<std::string>& names) const;

 private:
  OutputFolder(std::filesystem::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}
  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace pastefit
