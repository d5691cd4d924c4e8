#include "core/apparatus/shear_cell/shear_cell.h"

namespace pastefit {

std::vector<ReadingKind> reading_kinds(const ShearCell& test) {
  constexpr int pressed = 0, sheared = 1;
  constexpr double solid = 0.9;        // of the cell: more is no bed of grains
  constexpr double largest_ratio = 5;  // of shear and normal stress; friction of granules gives 1, sticking adds to it
  const double full_g = 1e3 * solid * test.bulk_density_kg_m3 * filled_volume_m3(test);
  const double fill_mm = 1e3 * test.fill_height_m, way_mm = 1e3 * test.final_displacement_m;
  const ReadingRange mass{0, full_g}, share{0, 1}, height{0, 1.5 * fill_mm}, way{0, way_mm};
  const ReadingRange stress{0, largest_ratio * test.normal_stress_pa};
  // clang-format off
  return {
    ReadingKind{.name = "bed.mass_g", .key = "bed.mass_g", .measure = "bed.mass_g", .stage = pressed,
                .possible = mass, .worst_miss = full_g, .advised = true, .checked = true},
    ReadingKind{.name = "bed.solid_fraction", .key = "", .measure = "", .stage = pressed, .possible = share},
    ReadingKind{.name = "bed.height_mm", .key = "bed.height_mm", .measure = "bed.height_mm", .stage = pressed,
                .possible = height, .worst_miss = fill_mm, .advised = true, .checked = true},
    ReadingKind{.name = "shear.stress_pa", .key = "shear.stress_pa", .measure = "shear.stress_pa", .stage = sheared,
                .possible = stress, .advised = true, .checked = true},
    ReadingKind{.name = "shear.peak_stress_pa", .key = "shear.peak_stress_pa", .measure = "shear.peak_stress_pa",
                .stage = sheared, .possible = stress, .advised = true, .checked = true},
    ReadingKind{.name = "shear.height_mm", .key = "shear.height_mm", .measure = "shear.height_mm", .stage = sheared,
                .possible = height, .worst_miss = fill_mm, .advised = true, .checked = true},
    ReadingKind{.name = "shear.stress_error_pa", .key = "", .measure = "", .stage = sheared, .possible = stress},
    ReadingKind{.name = "shear.steady_from_mm", .key = "", .measure = "", .stage = sheared, .possible = way}};
  // clang-format on
}

}  // namespace pastefit
