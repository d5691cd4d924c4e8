#include "calibrate/exports/size_classes.h"

#include <algorithm>
#include <cmath>

namespace pastefit {

SizeClasses size_classes(std::span<const double> radii, int most) {
  SizeClasses out;
  if (radii.empty()) return out;
  const auto [smallest, largest] = std::ranges::minmax(radii);
  const double width = (largest - smallest) / most;
  std::vector<double> cubes(static_cast<std::size_t>(most));
  std::vector<int> counts(cubes.size()), places(cubes.size());
  for (const double radius : radii) {
    const int bin = width > 0 ? std::min(static_cast<int>((radius - smallest) / width), most - 1) : 0;
    out.class_of.push_back(bin);
    cubes[bin] += radius * radius * radius;
    ++counts[bin];
  }
  for (std::size_t bin = 0; bin < cubes.size(); ++bin) {
    places[bin] = static_cast<int>(out.radii_m.size());
    if (counts[bin] > 0) out.radii_m.push_back(width > 0 ? std::cbrt(cubes[bin] / counts[bin]) : smallest);
  }
  for (std::size_t i = 0; i < radii.size(); ++i) {
    out.class_of[i] = places[out.class_of[i]];
    out.largest_change = std::max(out.largest_change, std::abs(out.radii_m[out.class_of[i]] / radii[i] - 1));
  }
  return out;
}

}  // namespace pastefit
