#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/slump.h"

namespace pastefit {
namespace {

struct OtherUnit {
  const char* name;
  double factor;  ///< for a length given in this unit, taken for millimetres
};
constexpr std::array<OtherUnit, 3> other_units{{{"cm", 10}, {"in", 25.4}, {"m", 1000}}};

/// Outline sorted by x.
struct SeenOutline {
  explicit SeenOutline(std::vector<OutlinePoint> given) : points(std::move(given)) {
    std::ranges::sort(points, {}, [](const auto& point) { return point[0]; });
    for (const auto& [x, z] : points) top = std::max(top, z);
  }
  double left() const { return points.front()[0]; }
  double right() const { return points.back()[0]; }
  double middle() const { return 0.5 * (left() + right()); }

  /// Volume of revolution about the middle, mean of both halves.
  double volume_m3() const {
    double sum = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const auto& [x0, z0] = points[k - 1];
      const auto& [x1, z1] = points[k];
      sum += (x1 - x0) * 0.5 * (std::abs(x0 - middle()) * z0 + std::abs(x1 - middle()) * z1);
    }
    return std::numbers::pi * sum;
  }

  /// Mean height of the points whose distance from the middle, over half of the width, is in this range.
  double mean_height(double from, double to) const {
    double sum = 0;
    int count = 0;
    for (const auto& [x, z] : points) {
      const double share = std::abs(x - middle()) / std::max(0.5 * (right() - left()), 1e-9);
      if (share < from || share > to) continue;
      sum += z;
      ++count;
    }
    return count > 0 ? sum / count : 0;
  }

  std::vector<OutlinePoint> points;
  double top = 0;
};

/// Unit for which lengths with this share of the mould's volume would give about all of it.
const OtherUnit* unit_for_volume(double share) {
  constexpr double least = 0.5, most = 2;
  for (const OtherUnit& unit : other_units)
    if (const double held = share * std::pow(unit.factor, 3); held >= least && held <= most) return &unit;
  return nullptr;
}

void check_outline(const std::string& place, const std::vector<OutlinePoint>& points, const SlumpTest& test,
                   Faults& faults) {
  constexpr double one_side = 0.25;                 // of the width: heaps shift by less
  constexpr double held_by_few = 0.3;               // of the mould's volume
  constexpr double high_ends = 0.6, low_top = 0.5;  // of the largest height
  if (points.empty()) return;
  const SeenOutline seen(points);
  const double width = seen.right() - seen.left();
  if (std::abs(seen.middle()) > one_side * width)
    faults.push_back({place,
                      format("lies to one side of the mould's axis: x goes from %.4g to %.4g mm", mm * seen.left(),
                             mm * seen.right()),
                      format("x from the axis, to both sides of the heap; off a picture's edge, subtract %.4g",
                             mm * seen.middle())});
  if (seen.mean_height(0.9, 1) > high_ends * seen.top && seen.mean_height(0, 0.4) < low_top * seen.top)
    faults.push_back({place,
                      format("is higher at its ends (%.4g mm) than in its middle (%.4g mm)",
                             mm * seen.mean_height(0.9, 1), mm * seen.mean_height(0, 0.4)),
                      "z upwards from the table"});
  const double share = seen.volume_m3() / volume_m3(test.mould);
  const OtherUnit* unit = share < held_by_few ? unit_for_volume(share) : nullptr;
  if (unit)
    faults.push_back(
        {place, format("holds %.2g of the mould's volume", share),
         format("in mm: as %s the points would hold %.2g of it", unit->name, share * std::pow(unit->factor, 3))});
}

/// Checks widths from the beginning of the lift: the first must be that of the mould.
void check_spread_curve(const std::string& place, const std::vector<SpreadPoint>& curve, const SlumpTest& test,
                        Faults& faults) {
  constexpr double room = 0.1;     // of the base
  constexpr double shrink = 0.05;  // of the width
  if (curve.empty()) return;
  const double base = 2 * test.mould.base_radius_m, first = curve.front()[1], last = curve.back()[1];
  const auto near_base = [&](double width) { return width > (1 - room) * base && width < 1.5 * base; };
  if (first < (1 - room) * base) {
    std::string remedy = "the width of the heap, in mm, from the beginning of the lift";
    if (near_base(2 * first))
      remedy += format("; if it is a radius, %.4g mm are a width of %.4g", mm * first, 2 * mm * first);
    for (const OtherUnit& unit : other_units)
      if (near_base(unit.factor * first))
        remedy += format("; if it is in %s, %.4g are %.4g mm", unit.name, mm * first, unit.factor * mm * first);
    faults.push_back(
        {place, format("begins with %.4g mm, less than the mould's base of %.4g mm", mm * first, mm * base), remedy});
  }
  double widest = 0;
  for (const auto& [time_s, width] : curve) widest = std::max(widest, width);
  if (last < (1 - shrink) * widest)
    faults.push_back({place, format("shrinks from %.4g to %.4g mm", mm * widest, mm * last),
                      "widths in the order of time: a heap does not draw together"});
}

}  // namespace

void check_curves(const SlumpTest& test, ReadingCheck& check) {
  check_outline("measurements.step1.profile", test.reading.outline_step1, test, check.faults);
  check_outline("measurements.step2.profile", test.reading.outline_step2, test, check.faults);
  check_spread_curve("measurements.step1.spread_curve", test.reading.spread_curve, test, check.faults);
}

}  // namespace pastefit
