#include "core/observe/readings.h"

#include <algorithm>

namespace pastefit {

void Readings::set(std::string_view name, double value) {
  const auto [place, added] = places_.try_emplace(std::string(name), readings_.size());
  if (added)
    readings_.push_back({place->first, value});
  else
    readings_[place->second].value = value;
}

std::optional<double> Readings::find(std::string_view name) const {
  const auto place = places_.find(std::string(name));
  if (place == places_.end()) return {};
  return readings_[place->second].value;
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
