#include "core/observe/observables.h"

#include <algorithm>

namespace pastefit {

void Observables::set(std::string_view name, double value) {
  const auto same = [&](const Observable& o) { return o.name == name; };
  if (const auto it = std::find_if(readings_.begin(), readings_.end(), same); it != readings_.end())
    it->value = value;
  else
    readings_.push_back({std::string(name), value});
}

std::optional<double> Observables::find(std::string_view name) const {
  for (const Observable& o : readings_)
    if (o.name == name) return o.value;
  return {};
}

Observables mean_of(const std::vector<Observables>& runs) {
  Observables mean;
  if (runs.empty()) return mean;
  for (const Observable& reading : runs.front().all()) {
    double sum = 0;
    const bool everywhere = std::all_of(runs.begin(), runs.end(), [&](const Observables& run) {
      const auto value = run.find(reading.name);
      sum += value.value_or(0);
      return value.has_value();
    });
    if (everywhere) mean.set(reading.name, sum / static_cast<double>(runs.size()));
  }
  return mean;
}

}  // namespace pastefit
