#include "core/observe/readings.h"

#include <algorithm>

namespace pastefit {

void Readings::set(std::string_view name, double value) {
  const auto same = [&](const Reading& o) { return o.name == name; };
  if (const auto it = std::find_if(readings_.begin(), readings_.end(), same); it != readings_.end())
    it->value = value;
  else
    readings_.push_back({std::string(name), value});
}

std::optional<double> Readings::find(std::string_view name) const {
  for (const Reading& o : readings_)
    if (o.name == name) return o.value;
  return {};
}

Readings mean_of(const std::vector<Readings>& runs) {
  Readings mean;
  if (runs.empty()) return mean;
  for (const Reading& reading : runs.front().all()) {
    double sum = 0;
    const bool everywhere = std::all_of(runs.begin(), runs.end(), [&](const Readings& run) {
      const auto value = run.find(reading.name);
      sum += value.value_or(0);
      return value.has_value();
    });
    if (everywhere) mean.set(reading.name, sum / static_cast<double>(runs.size()));
  }
  return mean;
}

}  // namespace pastefit
