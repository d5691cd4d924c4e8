#include "calibrate/cli/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/cli/standard_output.h"

namespace pastefit {

namespace fs = std::filesystem;

std::vector<std::string> with_store(std::vector<std::string> names) {
  for (const char* suffix : {"", "-wal", "-shm"}) names.push_back(kStore + suffix);
  return names;
}

bool is_stream(const fs::path& file) {
  const std::string name = file.string();
  if (name == "-" || name.starts_with("/dev/std") || name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/"))
    return true;
  const std::string special = kind_of_special_file(file);
  return special == "a FIFO" || special == "a device";
}

bool is_standard_output(const fs::path& file) {
  return file == "-" || file == "/dev/stdout" || file == "/dev/fd/1" || file == "/proc/self/fd/1";
}

Faults output_file_faults(const std::string& option, const fs::path& file, bool force) {
  const std::string where = option + " " + file.string();
  std::error_code error;
  if (const std::string special = kind_of_special_file(file); !special.empty())
    return {{where, "is " + special + ", and only a regular file is replaced", "the name of a file"}};
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!fs::is_directory(folder, error))
    return {{where, "there is no folder " + folder.string(), "make it, or choose another"}};
  if (!force && fs::exists(file, error))
    return {{where, "is there already", "choose another name, or replace it with --force"}};
  const fs::path probe = file.string() + ".pastefit-probe";
  Faults faults = write_atomically(probe, ".");
  fs::remove(probe, error);
  for (Fault& fault : faults) fault.where = where;
  return faults;
}

Faults output_faults(const std::string& option, const fs::path& file, bool force) {
  return is_stream(file) ? Faults{} : output_file_faults(option, file, force);
}

Faults output_folder_faults(const std::string& option, const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (!fs::exists(fs::symlink_status(there, error)) && there.has_relative_path()) there = there.parent_path();
  const std::string where = option + " " + folder.string();
  if (!fs::is_directory(there, error))
    return {{where, there.string() + " is no folder", "choose a folder that can be made"}};
  if (::access(there.c_str(), W_OK | X_OK) == 0) return {};
  return {
      {where, there.string() + " cannot be written: " + std::strerror(errno), "choose a folder that can be written"}};
}

Faults write_output(const fs::path& file, std::string_view content) {
  if (is_standard_output(file)) {
    print("%.*s", static_cast<int>(content.size()), content.data());
    return {};
  }
  if (!is_stream(file)) return write_atomically(file, content);
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out.write(content.data(), static_cast<std::streamsize>(content.size())).flush();
  if (out) return {};
  return {{file.string(), std::string("cannot be written: ") + std::strerror(errno), "something that can be written"}};
}

/// Results are replaced, so that none of them may be a link to somewhere else, or a device.
Faults special_files(const fs::path& folder, const std::vector<std::string>& results) {
  for (const auto& name : results)
    if (const std::string special = kind_of_special_file(folder / name); !special.empty())
      return {{"--out " + folder.string(), "holds " + name + ", which is " + special,
               "move it away, or choose another folder"}};
  return {};
}

Result<OutputFolder> OutputFolder::open(const fs::path& folder, const std::vector<std::string>& results,
                                        EarlierResult earlier, std::uintmax_t space_bytes) {
  const std::string where = "--out " + folder.string();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Fault{where, "cannot be made: " + error.message(), "choose a folder that can be written"};

  if (Faults special = special_files(folder, results); !special.empty()) return special;
  if (earlier == EarlierResult::refuse)
    for (const auto& name : results)
      if (fs::exists(folder / name, error))
        return Fault{where, "holds an earlier result (" + name + ")",
                     "choose another folder, go on with --resume where there is one, or replace it with --force"};

  const bool with_store = std::ranges::find(results, kStore) != results.end();
  if (earlier == EarlierResult::resume && with_store && !fs::exists(folder / kStore, error))
    for (const auto& name : results)
      if (fs::exists(folder / name, error))
        return Fault{where, "holds " + name + ", but no " + kStore + " to go on with",
                     "choose another folder, or replace what is there with --force"};

  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock < 0) return Fault{where, std::strerror(errno), "choose a folder that can be read and written"};
  OutputFolder out(folder, lock);
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return Fault{where, "is in use by another run of pastefit", "wait for it, or choose another folder"};

  const auto space = fs::space(folder, error);
  if (!error && space.available < space_bytes)
    return Fault{where, "has " + std::to_string(space.available >> 20) + " MB of free space",
                 "at least " + std::to_string((space_bytes >> 20) + 1) + " MB; free some, or choose another disk"};

  const auto probe = out.file(".pastefit-probe");
  auto faults = write_atomically(probe, std::string(4096, '.'));
  fs::remove(probe, error);
  if (!faults.empty()) {
    faults[0].where = where;
    return faults;
  }
  return out;
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : folder_(std::move(other.folder_)), lock_(std::exchange(other.lock_, -1)) {}

OutputFolder& OutputFolder::operator=(OutputFolder&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(lock_, other.lock_);
  return *this;
}

OutputFolder::~OutputFolder() {
  if (lock_ >= 0) ::close(lock_);
}

void OutputFolder::clear(const std::vector<std::string>& names) const {
  std::error_code error;
  for (const auto& name : names) fs::remove(file(name), error);
}

}  // namespace pastefit
