#include "calibrate/laboratory/drawing.h"

#include <algorithm>

namespace pastefit {

std::optional<double> mean_reading(std::span<const SeenRun> runs, std::string_view name) {
  double sum = 0;
  for (const SeenRun& run : runs) {
    const auto value = run.readings.find(name);
    if (!value) return std::nullopt;
    sum += *value;
  }
  return runs.empty() ? std::nullopt : std::optional(sum / static_cast<double>(runs.size()));
}

const Measurement* find_measurement(std::span<const Measurement> measured, std::string_view name) {
  const auto found = std::ranges::find(measured, name, &Measurement::reading);
  return found == measured.end() ? nullptr : &*found;
}

}  // namespace pastefit
