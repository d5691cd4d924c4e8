#include "core/apparatus/pellet_crush/pellet_crush.h"

namespace pastefit {

std::vector<ReadingKind> reading_kinds(const PelletCrush& test) {
  constexpr int pressed = 0, crushed = 1;
  constexpr double solid = 0.9;  // of the die: more is no bed of grains
  constexpr double strongest_pa = 1e6;
  const double full_g = 1e3 * solid * test.bulk_density_kg_m3 * filled_volume_m3(test);
  const double fill_mm = 1e3 * test.fill_height_m;
  const ReadingRange mass{0, full_g}, share{0, 1}, height{0, 1.5 * fill_mm}, strength{0, strongest_pa};
  // clang-format off
  return {
    ReadingKind{.name = "die.mass_g", .key = "die.mass_g", .measure = "die.mass_g", .stage = pressed,
                .possible = mass, .worst_miss = full_g, .advised = true, .checked = true},
    ReadingKind{.name = "die.solid_fraction", .key = "", .measure = "", .stage = pressed, .possible = share},
    ReadingKind{.name = "pellet.height_mm", .key = "pellet.height_mm", .measure = "pellet.height_mm",
                .stage = pressed, .possible = height, .worst_miss = fill_mm, .advised = true, .checked = true},
    ReadingKind{.name = "pellet.dynamic_yield_strength_pa", .key = "pellet.dynamic_yield_strength_pa",
                .measure = "pellet.dynamic_yield_strength_pa", .stage = crushed, .possible = strength,
                .advised = true, .checked = true},
    ReadingKind{.name = "pellet.strain_at_peak", .key = "pellet.strain_at_peak", .measure = "pellet.strain_at_peak",
                .stage = crushed, .possible = share, .worst_miss = 1, .advised = true, .checked = true}};
  // clang-format on
}

}  // namespace pastefit
