#include "calibrate/laboratory/sketch.h"

#include <algorithm>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"

namespace pastefit {

namespace {

constexpr std::size_t kPoints = 50;
constexpr double kInterval = 0.1;  // simulated time [s] between two outlines
constexpr int kDigits = 3;

/// Outline from edge to edge.
Sketch sketch_of(const Outline& heap) {
  const auto stands = [](double height) { return height > 0; };
  const auto& heights = heap.height_m;
  const auto left = std::ranges::find_if(heights, stands);
  if (left == heights.end()) return {};
  const auto right = std::find_if(heights.rbegin(), heights.rend(), stands);
  const double from = heap.first_x_m + heap.spacing_m * static_cast<double>(left - heights.begin());
  const double to = heap.first_x_m + heap.spacing_m * static_cast<double>(heights.rend() - right - 1);
  Sketch out{true, {}};
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double x = from + (to - from) * static_cast<double>(k) / (kPoints - 1);
    out.points.push_back({rounded(mm * x, kDigits), rounded(mm * heap.at(x), kDigits)});
  }
  return out;
}

Sketch sketch_of(const Curve& curve) {
  Sketch out;
  const std::size_t count = curve.points.size(), stride = std::max<std::size_t>(count / kPoints, 1);
  for (std::size_t k = 0; k < count; k += stride)
    out.points.push_back({rounded(curve.points[k].x, kDigits), rounded(curve.points[k].y, kDigits)});
  return out;
}

}  // namespace

void Sketcher::see(const Test& test, const Snapshot& snapshot) {
  if (!snapshot.world || (snapshot.time_s >= seen_s_ && snapshot.time_s < seen_s_ + kInterval)) return;
  auto heap = heap_at(test, snapshot);
  if (!heap) return;
  heap_ = std::move(*heap);
  seen_s_ = snapshot.time_s;
}

Sketch Sketcher::sketch(const Outcome& outcome) const {
  return outcome.curve ? sketch_of(*outcome.curve) : sketch_of(heap_);
}

}  // namespace pastefit
