#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// Free space that a command asks for: a million exported grains take some 60 MB, a picture of 100,000 some 10 MB.
inline constexpr std::uintmax_t kSpace = 64u << 20;

/// Where a command keeps its evaluations.
inline const std::string kStore = "evaluations.sqlite";
/// `names`, the store's and those of the files that SQLite keeps beside it.
std::vector<std::string> with_store(std::vector<std::string> names);

/// What to do with the result that a folder already holds.
enum class EarlierResult { refuse, resume, replace };

/// A folder that was checked before anything runs: it exists, can be written, has space, and belongs to this process
/// until the object is gone. Nothing in it is changed by opening.
class OutputFolder {
 public:
  /// `results`: names of the files whose presence makes an earlier result. `space_bytes`: free space that is needed.
  /// Errors: cannot be made or written, too little space, holds an earlier result (`refuse`), in use by another run.
  static Result<OutputFolder> open(const std::filesystem::path& folder, const std::vector<std::string>& results,
                                   EarlierResult earlier, std::uintmax_t space_bytes);

  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&& other) noexcept;
  ~OutputFolder();

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  /// Removes these files.
  void clear(const std::vector<std::string>& names) const;

 private:
  OutputFolder(std::filesystem::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}
  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace pastefit
