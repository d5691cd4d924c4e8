#include "core/apparatus/slump/ruler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace pastefit {

Ruler::Ruler(const SlumpTest& test, double roughness_m, const Particles& in_mould)
    : test_(test), roughness_m_(roughness_m), on_top_(in_mould.count(), 0) {
  const double below = std::min(test.mould.height_m, highest_point(in_mould)) - 2 * test.grains.radius_m;
  for (std::int32_t i = 0; i < in_mould.count(); ++i)
    on_top_[in_mould.identity[i]] = in_mould.motion[i].position.z > below;
}

Disc Ruler::top(const Particles& grains) const {
  Disc disc{0, 0, test_.reading.probe_diameter_m};
  double count = 0;
  for (std::int32_t i = 0; i < grains.count(); ++i) {
    if (!on_top_[grains.identity[i]]) continue;
    disc.x += grains.motion[i].position.x;
    disc.y += grains.motion[i].position.y;
    ++count;
  }
  disc.x /= std::max(count, 1.0);
  disc.y /= std::max(count, 1.0);
  return disc;
}

Ruler::Heights Ruler::heights(const Particles& grains) const {
  const double rim = test_.mould.height_m;
  Heights heights{.probe = top(grains)};
  heights.surface = std::min(mean_height(grains, test_.grains.radius_m, heights.probe) + roughness_m_, rim);
  heights.highest = std::clamp(highest_point(grains), heights.surface, rim);
  return heights;
}

/// The height that the laboratory measures.
double Ruler::read_height(const Heights& heights) const {
  return test_.reading.height == HeightReading::axis ? heights.surface : heights.highest;
}

/// Limit of a width: that of a table covered to its corners.
double Ruler::widest_m() const {
  return std::max(test_.table_length_m, 2 * test_.mould.base_radius_m);
}

double Ruler::spread_m(const Particles& all) const {
  return std::min(widths(on_table(all), test_.grains.radius_m).mean, widest_m());
}

void Ruler::read_after_drops(const Particles& all, Readings& readings) const {
  const Particles grains = on_table(all);
  readings.set("after_drops.spilled_share", 1 - static_cast<double>(grains.count()) / all.count());
  if (grains.count() == 0) return;
  readings.set("after_drops.height_mm", 1e3 * read_height(heights(grains)));
  readings.set("after_drops.spread_mm", 1e3 * spread_m(all));
}

void Ruler::read(const Particles& all, std::string_view step, Readings& readings) const {
  const Particles grains = on_table(all);
  const double radius = test_.grains.radius_m, rim = test_.mould.height_m;
  const auto set = [&](const char* name, double value) { readings.set(std::string(step) + name, value); };
  set(".spilled_share", 1 - static_cast<double>(grains.count()) / all.count());
  if (grains.count() == 0) return;
  const auto [probe, surface, highest] = heights(grains);
  const double height = read_height({probe, surface, highest});
  const Widths spread = widths(grains, radius);
  const double table = widest_m();
  set(".height_mm", 1e3 * height);
  set(".slump_mm", 1e3 * (rim - height));
  set(".height_axis_mm", 1e3 * surface);
  set(".height_max_mm", 1e3 * highest);
  set(".lateral_shift_mm", 1e3 * std::sqrt(probe.x * probe.x + probe.y * probe.y));
  set(".spread_mm", 1e3 * std::min(spread.mean, table));
  set(".spread_orthogonal_mm", 1e3 * std::min(spread.orthogonal, table));
  const bool dropped = step == "step2";
  if (const auto& flank = test_.reading.flank; flank && !dropped)
    if (const auto angle = flank_angle(grains, radius, flank->lower_share, flank->upper_share))
      set(".angle_of_repose_deg", 180 / std::numbers::pi * *angle);
  const auto& measured = dropped ? test_.reading.outline_step2 : test_.reading.outline_step1;
  if (!dropped && measured.empty()) return;
  const Outline side = outline(grains, radius);
  if (!measured.empty()) set(".profile_mm", 1e3 * rms_difference(side, measured));
  if (!dropped) return;
  const double window = test_.reading.sag_window_m;
  if (test_.drop->motion == TableMotion::hinged)
    set(".plateau_sag_mm", -1e3 * window * slope_along_x(grains, radius, {0, 0, window}));
  set(".plateau_width_mm", 1e3 * plateau_width(side));
}

double shear_index(const SlumpTest& test, const Readings& readings) {
  const auto shift_mm = readings.find("step1.lateral_shift_mm");
  return shift_mm ? 1e-3 * *shift_mm / (kShearedShift * wider_radius_m(test.mould)) : std::nan("");
}

bool has_sheared(const SlumpTest& test, const Readings& readings) {
  return shear_index(test, readings) > 1;
}

Particles on_table(const Particles& grains) {
  Particles result = grains;
  std::size_t kept = 0;
  for (std::int32_t i = 0; i < grains.count(); ++i) {
    if (grains.motion[i].position.z < 0) continue;
    result.motion[kept] = grains.motion[i];
    result.velocity[kept] = grains.velocity[i];
    result.identity[kept++] = grains.identity[i];
  }
  result.identity.resize(kept);
  result.motion.resize(kept);
  result.velocity.resize(kept);
  result.load.resize(kept);
  provide_dummies(result, 1);
  return result;
}

}  // namespace pastefit
