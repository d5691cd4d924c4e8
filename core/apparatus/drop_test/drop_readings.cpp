#include <cmath>

#include "core/apparatus/drop_test/drop_test.h"

namespace pastefit {

std::vector<ReadingKind> reading_kinds(const DropTest& test) {
  constexpr int level = 0, tilted = 1;
  constexpr double room = 0.02;  // for the tolerances of an apparatus
  constexpr Lack not_tilted{"the plate is not tilted, so the ball falls on a level one only",
                            "leave it out, or give the angle in apparatus.plate_tilt_deg"};
  const double fall_mm = 1e3 * test.drop_height_m;
  const ReadingRange height{0, (1 + room) * fall_mm};
  // A ball that rolls without sliding has 5/7 of this; one whose surface springs back no more than twice that.
  const double along_plate_m_s = impact_speed_m_s(test) * std::sin(test.plate_tilt_rad);
  const ReadingRange spin{0, 10.0 / 7 * (1 + room) * along_plate_m_s / test.grains.radius_m};
  // clang-format off
  std::vector<ReadingKind> kinds{
    ReadingKind{.name = "level.rebound_height_mm", .key = "level.rebound_height_mm",
                .measure = "level.rebound_height_mm", .stage = level, .possible = height, .worst_miss = fall_mm,
                .advised = true, .checked = true},
    ReadingKind{.name = "tilted.rebound_height_mm", .key = "tilted.rebound_height_mm",
                .measure = "tilted.rebound_height_mm", .stage = tilted, .possible = height, .worst_miss = fall_mm,
                .advised = true, .checked = true},
    ReadingKind{.name = "tilted.spin_rad_s", .key = "tilted.spin_rad_s", .measure = "tilted.spin_rad_s",
                .stage = tilted, .possible = spin, .worst_miss = spin.largest, .advised = true, .checked = true}};
  // clang-format on
  if (test.plate_tilt_rad == 0)
    for (ReadingKind& kind : kinds)
      if (kind.stage == tilted) kind.lack = not_tilted;
  return kinds;
}

}  // namespace pastefit
