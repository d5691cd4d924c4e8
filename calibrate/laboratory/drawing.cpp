#include "calibrate/laboratory/drawing.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "calibrate/base/text.h"

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

Drawing drawing_of_curves(std::string name, std::string x, std::string y, std::span<const SeenRun> runs) {
  Drawing drawing;
  drawing.name = std::move(name);
  drawing.x = std::move(x);
  drawing.y = std::move(y);
  std::vector<const Curve*> curves;
  for (const SeenRun& run : runs)
    if (run.curve) curves.push_back(&*run.curve);
  if (curves.empty()) return drawing;
  const auto points_of = [](const Curve* curve) { return curve->points.size(); };
  const std::size_t points = points_of(*std::ranges::min_element(curves, {}, points_of));
  DrawnBand band{format("%zu packings, lowest to highest", curves.size()), {}};
  DrawnLine mean{"simulated, mean", DrawnBy::simulation, {}};
  for (std::size_t i = 0; i < points; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0;
    for (const Curve* curve : curves) {
      const double value = curve->points[i].y;
      low = std::min(low, value);
      high = std::max(high, value);
      sum += value;
    }
    const double at = curves.front()->points[i].x;
    band.points.push_back({at, low, high});
    mean.points.push_back({at, sum / static_cast<double>(curves.size())});
  }
  if (curves.size() > 1) drawing.bands.push_back(std::move(band));
  drawing.lines.push_back(std::move(mean));
  return drawing;
}

}  // namespace pastefit
