#include "calibrate/store/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "calibrate/base/atomic_file.h"

namespace pastefit {

namespace fs = std::filesystem;

std::vector<std::string> with_store(std::vector<std::string> names) {
  for (const char* suffix : {"", "-wal", "-shm"}) names.push_back(kStore + suffix);
  return names;
}

Result<OutputFolder> OutputFolder::open(const fs::path& folder, const std::vector<std::string>& results,
                                        EarlierResult earlier, std::uintmax_t space_bytes) {
  const std::string where = "--out " + folder.string();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Fault{where, "cannot be made: " + error.message(), "choose a folder that can be written"};

  for (const auto& name : results)  // they are replaced
    if (const std::string special = kind_of_special_file(folder / name); !special.empty())
      return Fault{where, "holds " + name + ", which is " + special, "move it away, or choose another folder"};
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
  OutputFolder out(folder, {nullptr, [lock](void*) { ::close(lock); }});
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return Fault{where, "is in use by another run of pastefit", "wait for it, or choose another folder"};

  const auto space = fs::space(folder, error);
  if (!error && space.available < space_bytes)
    return Fault{where, "has " + std::to_string(space.available >> 20) + " MB of free space",
                 "at least " + std::to_string((space_bytes >> 20) + 1) + " MB; free some, or choose another disk"};

  constexpr std::size_t kProbeBytes = 4096;
  if (auto faults = probe_beside(out.file("pastefit-probe"), kProbeBytes); !faults.empty()) {
    faults[0].where = where;
    return faults;
  }
  return out;
}

void OutputFolder::clear(const std::vector<std::string>& names) const {
  std::error_code error;
  for (const auto& name : names) fs::remove(file(name), error);
}

}  // namespace pastefit
