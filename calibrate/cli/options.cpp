#include "calibrate/cli/options.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/output_file.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace {

/// Parses the whole text as a number.
template <class Number>
std::optional<Number> number_of(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return number;
}

template <class Number, class Holds>
CLI::Validator check_that(std::string right, Holds holds) {
  return CLI::Validator(
      [right = std::move(right), holds](std::string& text) -> std::string {
        const auto number = number_of<Number>(text);
        return number && holds(*number) ? "" : "is " + in_quotes(text) + "; give " + right;
      },
      "");
}

namespace fs = std::filesystem;

constexpr double kHour_s = 3600, kDay_s = 24 * kHour_s;
// Measured with a mould of 287 grains: 160 kB per picture in blocks of 4 kB, half of it for the links.
constexpr double kBytesPerGrain = 500, kBytesPerPicture = 12e3;

}  // namespace

CLI::Validator positive_number() {
  return check_that<double>("a number above 0, at most 1e9", [](double number) { return number > 0 && number <= 1e9; });
}

CLI::Validator number_from(double smallest, double largest) {
  return check_that<double>("a number from " + shown(smallest) + " to " + shown(largest),
                            [=](double number) { return number >= smallest && number <= largest; });
}

CLI::Validator whole_number(std::uint64_t smallest, std::uint64_t largest) {
  return check_that<std::uint64_t>("a whole number from " + std::to_string(smallest) + " to " + std::to_string(largest),
                                   [=](std::uint64_t number) { return number >= smallest && number <= largest; });
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

}  // namespace pastefit
