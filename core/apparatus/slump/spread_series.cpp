#include "core/apparatus/slump/spread_series.h"

#include <algorithm>
#include <cmath>

#include "core/apparatus/slump/ruler.h"
#include "core/observe/heap.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

constexpr double kInterval = 0.01;  // [s]
constexpr double kSpread = 0.99;    // share of the final spread at which the flow has stopped

/// Where the line through both points reaches this height.
double crossing(const CurvePoint& a, const CurvePoint& b, double y) {
  return a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
}

}  // namespace

bool is_timed(const SlumpTest& test) {
  return test.reading.flow.has_value() || !test.reading.spread_curve.empty();
}

void SpreadSeries::take(const World& world, double mean_radius) {
  if (start_ < 0) start_ = world.time;
  const double elapsed = world.time - start_;
  if (elapsed < kInterval * static_cast<double>(points_.size())) return;
  points_.push_back({elapsed, widths(on_table(world.particles), mean_radius).mean});
}

std::optional<double> SpreadSeries::time_to(double width_m) const {
  const auto wide = std::ranges::find_if(points_, [&](const CurvePoint& point) { return point.y >= width_m; });
  if (wide == points_.end()) return std::nullopt;
  return wide == points_.begin() ? wide->x : crossing(*std::prev(wide), *wide, width_m);
}

double SpreadSeries::time_of_flow() const {
  if (points_.empty()) return 0;
  const double width = kSpread * points_.back().y;
  for (std::size_t k = points_.size() - 1; k > 0; --k)
    if (points_[k - 1].y < width) return crossing(points_[k - 1], points_[k], width);
  return 0;
}

double SpreadSeries::at(double time_s) const {
  const auto after = std::ranges::find_if(points_, [&](const CurvePoint& point) { return point.x >= time_s; });
  if (after == points_.end()) return points_.back().y;
  if (after == points_.begin()) return after->y;
  const CurvePoint &a = *std::prev(after), &b = *after;
  return a.y + (b.y - a.y) * (time_s - a.x) / (b.x - a.x);
}

double SpreadSeries::rms_difference(const std::vector<SpreadPoint>& measured) const {
  double squares = 0;
  for (const auto& [time_s, width_m] : measured) squares += (at(time_s) - width_m) * (at(time_s) - width_m);
  return std::sqrt(squares / static_cast<double>(measured.size()));
}

Curve SpreadSeries::curve() const {
  Curve out{"spread_over_time", "time_s", "spread_mm", {}};
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const double time_s = kInterval * static_cast<double>(k);
    out.points.push_back({time_s, 1e3 * at(time_s)});
  }
  return out;
}

bool SpreadSeries::is_sound() const {
  return std::ranges::all_of(points_, [](const CurvePoint& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && point.x >= 0 && point.y >= 0;
  });
}

}  // namespace pastefit
