#include "calibrate/models/replicates.h"

#include <algorithm>

namespace pastefit {

Sites sites_of(std::span<const UnitPoint> points) {
  Sites sites;
  for (const UnitPoint& point : points) {
    const auto known = std::ranges::find(sites.points, point);
    sites.of.push_back(static_cast<std::size_t>(known - sites.points.begin()));
    if (known == sites.points.end()) sites.points.push_back(point);
  }
  return sites;
}

}  // namespace pastefit
