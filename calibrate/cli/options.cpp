#include "calibrate/cli/options.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/machine.h"
#include "calibrate/base/refusal.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace {

/// Checks that the whole text is a number from `smallest` to `largest`; `right`: the correct form.
template <class Number>
CLI::Validator number_within(std::string right, Number smallest, Number largest) {
  return CLI::Validator(
      [right = std::move(right), smallest, largest](std::string& text) -> std::string {
        const auto number = parsed_number<Number>(text);
        return number && *number >= smallest && *number <= largest ? "" : "is " + in_quotes(text) + "; give " + right;
      },
      "");
}

namespace fs = std::filesystem;

constexpr double kHour_s = 3600, kDay_s = 24 * kHour_s;
// Measured with a mould of 287 grains: 160 kB per picture in blocks of 4 kB, half of it for the links.
constexpr double kBytesPerGrain = 500, kBytesPerPicture = 12e3;

/// Content is written there, and no file is replaced.
bool is_stream(const fs::path& file) {
  const std::string name = file.string();
  if (name == "-" || name.starts_with("/dev/std") || name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/"))
    return true;
  const std::string special = kind_of_special_file(file);
  return special == "a FIFO" || special == "a device";
}

/// The folder as an absolute path, or its nearest existing parent.
fs::path nearest_there(fs::path folder) {
  std::error_code error;
  folder = fs::absolute(folder, error);
  while (!fs::exists(fs::symlink_status(folder, error)) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

}  // namespace

CLI::Validator positive_number() {
  return number_within("a number above 0, at most 1e9", std::numeric_limits<double>::denorm_min(), 1e9);
}

CLI::Validator number_from(double smallest, double largest) {
  return number_within("a number from " + shown(smallest) + " to " + shown(largest), smallest, largest);
}

CLI::Validator whole_number(std::uint64_t smallest, std::uint64_t largest) {
  return number_within("a whole number from " + std::to_string(smallest) + " to " + std::to_string(largest), smallest,
                       largest);
}

Faults long_run_faults(const std::string& where, const std::string& work, double processor_s, int threads, bool force,
                       const std::string& remedy) {
  const int here = processors();
  const double wall_s = processor_s / (threads > 0 ? std::min(threads, here) : here);
  const std::string time = range_of_time(wall_s, wall_s);
  if (wall_s > kDay_s && !force)
    return {{where, work + " take at least " + time, remedy + ", or --force to start anyway"}};
  if (wall_s > kHour_s) note("pastefit: %s take at least %s\n", work.c_str(), time.c_str());
  return {};
}

Faults picture_faults(const fs::path& folder, double pictures, double grains, bool force) {
  std::error_code error;
  const auto space = fs::space(nearest_there(folder), error);
  const double needed = pictures * (kBytesPerPicture + grains * kBytesPerGrain);
  if (error || force || needed <= static_cast<double>(space.available)) return {};
  return {{"--vtk",
           format("about %.3g pictures take %.3g GB, and %s has %.3g GB free", pictures, needed / 1e9, folder.c_str(),
                  static_cast<double>(space.available) / 1e9),
           "a longer interval, another disk, or --force to write until it is full"}};
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
    print(std::string(content));
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
  if (!is_standard_output(out)) print(json ? content : words);
  if (out.empty()) return;
  refuse(write_output(out, content), kFailed);
  if (!is_stream(out)) note("wrote %s\n", out.c_str());
}

}  // namespace pastefit
