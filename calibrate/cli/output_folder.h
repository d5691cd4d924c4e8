#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
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

/// True of "-", of what the system calls /dev/stdout and the like, and of devices and FIFOs: content goes there, and
/// nothing is replaced.
bool is_stream(const std::filesystem::path& file);
/// True of "-" and the names of standard output: what else the command prints would get in between.
bool is_standard_output(const std::filesystem::path& file);

/// What keeps `file`, given as `option`, from being written: it is there and may not be replaced, it is no regular
/// file, or its folder is not there or cannot be written. To be asked before anything runs.
Faults output_file_faults(const std::string& option, const std::filesystem::path& file, bool force);
/// The same where a stream will do, too.
Faults output_faults(const std::string& option, const std::filesystem::path& file, bool force);

/// What keeps a folder, given as `option`, from being made or written. To be asked before anything runs; nothing is
/// made.
Faults output_folder_faults(const std::string& option, const std::filesystem::path& folder);

/// Writes to a stream, or replaces the file (`write_atomically`).
Faults write_output(const std::filesystem::path& file, std::string_view content);

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

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  /// Removes these files.
  void clear(const std::vector<std::string>& names) const;

 private:
  OutputFolder(std::filesystem::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}
  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace pastefit
