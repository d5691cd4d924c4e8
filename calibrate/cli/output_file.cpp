#include "calibrate/cli/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/refusal.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace fs = std::filesystem;

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
  Faults faults = probe_beside(file, 1);
  for (Fault& fault : faults) fault.where = where;
  return faults;
}

Faults output_faults(const std::string& option, const fs::path& file, bool force) {
  return is_stream(file) ? Faults{} : output_file_faults(option, file, force);
}

fs::path nearest_there(fs::path folder) {
  std::error_code error;
  folder = fs::absolute(folder, error);
  while (!fs::exists(fs::symlink_status(folder, error)) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

Faults output_folder_faults(const std::string& option, const fs::path& folder) {
  std::error_code error;
  const fs::path there = nearest_there(folder);
  const std::string where = option + " " + folder.string();
  if (!fs::is_directory(there, error))
    return {{where, there.string() + " is not a folder", "choose a folder that can be made"}};
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

void deliver_card(const Card& card, const std::string& words, bool json, const fs::path& out) {
  const std::string content = value_or_throw(readable_text(card), kFailed);
  if (!is_standard_output(out)) print("%s", (json ? content : words).c_str());
  if (out.empty()) return;
  refuse(write_output(out, content), kFailed);
  if (!is_stream(out)) note("wrote %s\n", out.c_str());
}

}  // namespace pastefit
