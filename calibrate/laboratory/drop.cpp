#include "calibrate/laboratory/drop.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "core/world/world.h"

namespace pastefit {
namespace {

/// Half of a free flight that ends at `end_s`: from the top to touch (`half_s` < 0), or from touch to the top.
std::vector<DrawnPoint> flight(double height_m, double end_s, double half_s) {
  constexpr int kPoints = 40;
  std::vector<DrawnPoint> points;
  for (int k = 0; k <= kPoints; ++k) {
    const double share = static_cast<double>(k) / kPoints;   // of the duration
    const double from_top = half_s < 0 ? share : 1 - share;  // as a fraction of the half
    points.push_back({end_s - std::abs(half_s) * (1 - share), mm * height_m * (1 - from_top * from_top)});
  }
  return points;
}

}  // namespace

nlohmann::ordered_json conditions_of(const DropTest& test) {
  return {{"drop_height_m", test.drop_height_m}, {"impact_speed_m_s", impact_speed_m_s(test)}};
}

std::string conditions_in_words(const DropTest& test) {
  std::string out = format("  drop                     from %g mm, %.3g m/s at touch", mm * test.drop_height_m,
                           impact_speed_m_s(test));
  if (test.plate_tilt_rad > 0)
    out += format(", on a level plate and on one tilted by %g deg", degrees * test.plate_tilt_rad);
  return out + "\n";
}

std::vector<Drawing> drawings_of(const DropTest& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured) {
  std::vector<Drawing> out;
  for (const std::string stage : {"level", "tilted"}) {
    if (stage == "tilted" && test.plate_tilt_rad == 0) continue;
    const std::string reading = stage + ".rebound_height_mm";
    Drawing drawing;
    drawing.name = stage == "level" ? "Drop on the level plate"
                                    : format("Drop on the plate tilted by %.3g degrees", degrees * test.plate_tilt_rad);
    drawing.x = "time [s]";
    drawing.y = "height of the ball above touch [mm]";
    const double touch_s = std::sqrt(2 * test.drop_height_m / kGravity);
    drawing.lines.push_back({"fall", DrawnBy::apparatus, flight(test.drop_height_m, touch_s, -touch_s)});
    const auto rebound = [&](DrawnBy by, const char* name, double height_mm, double deviation) {
      const double rise_s = std::sqrt(2 * std::max(height_mm, 0.0) / mm / kGravity);
      drawing.lines.push_back({name, by, flight(height_mm / mm, touch_s + rise_s, rise_s), 0});
      const double top_s = touch_s + rise_s;
      const double beside_s = top_s * (by == DrawnBy::laboratory ? 1.06 : 1.14);  // side by side
      drawing.lengths.push_back(
          {reading, by, {beside_s, 0}, {beside_s, height_mm}, {top_s, 0}, {top_s, height_mm}, height_mm, deviation});
    };
    if (const Measurement* one = find_measurement(measured, reading))
      rebound(DrawnBy::laboratory, "rebound, laboratory", one->value, one->standard_deviation);
    if (const auto mean = mean_reading(runs, reading)) rebound(DrawnBy::simulation, "rebound, simulated", *mean, 0);
    out.push_back(std::move(drawing));
  }
  return out;
}

}  // namespace pastefit
