#include "calibrate/cli/effort_checks.h"

#include <algorithm>

#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

constexpr double kHour_s = 3600, kDay_s = 24 * kHour_s;
// Measured of a mould of 287 grains: 160 kB a picture in blocks of 4 kB, half of it the links.
constexpr double kBytesPerGrain = 500, kBytesPerPicture = 12e3;

/// The folder itself, or the nearest above it that is there.
fs::path nearest_folder(fs::path folder) {
  std::error_code error;
  folder = fs::absolute(folder, error);
  while (!fs::is_directory(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

}  // namespace

Faults long_run_faults(const std::string& where, const std::string& work, double processor_s, int threads, bool force,
                       const std::string& remedy) {
  const int here = processors();
  const double wall_s = processor_s / (threads > 0 ? std::min(threads, here) : here);
  const std::string time = range_of_time(wall_s, wall_s);
  if (wall_s > kDay_s && !force)
    return {{where, work + " take at least " + time, remedy + ", or --force to compute for that long"}};
  if (wall_s > kHour_s) note("pastefit: %s take at least %s\n", work.c_str(), time.c_str());
  return {};
}

Faults picture_faults(const fs::path& folder, double pictures, double grains, bool force) {
  std::error_code error;
  const auto space = fs::space(nearest_folder(folder), error);
  const double needed = pictures * (kBytesPerPicture + grains * kBytesPerGrain);
  if (error || force || needed <= static_cast<double>(space.available)) return {};
  return {{"--vtk",
           format("about %.3g pictures take %.3g GB, and %s has %.3g GB free", pictures, needed / 1e9, folder.c_str(),
                  static_cast<double>(space.available) / 1e9),
           "a longer interval, another disk, or --force to write until it is full"}};
}

}  // namespace pastefit
