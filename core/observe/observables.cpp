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

}  // namespace pastefit
