#include "core/apparatus/shear_cell/shear_cell.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/apparatus/field_checker.h"
#include "core/apparatus/granules.h"

namespace pastefit {

namespace {

constexpr double kGranulesAcross = 5;      // smallest number across the cell, and between the tips of its ribs
constexpr double kFastestInertial = 0.01;  // inertial number above which stress is known to rise with speed

void check_ribs(FieldChecker& check, const ShearCell& test, const RibSizes& ribs, const std::string& name) {
  const auto at = [&](const char* field) { return name + "." + field; };
  const double height = test.fill_height_m, length = test.length_m, granule = 2 * largest_radius(test.grains);
  check_dimensions(check, ribs, rib_dimensions, name + ".");
  check.range(at("height_m"), ribs.height_m, 0, height, "m");
  check.range(at("thickness_m"), ribs.thickness_m, 1e-6, length, "m");
  check.range(at("pitch_m"), ribs.pitch_m, 1e-6, length, "m");
  if (!(ribs.pitch_m > 0 && length >= ribs.pitch_m)) return;
  const double gap = even_pitch_m(ribs, length) - ribs.thickness_m;
  check.require(
      ribs.height_m == 0 || gap >= granule, at("pitch_m"),
      "leaves " + FieldChecker::in_mm(gap) + " between two ribs, less than a granule of " +
          FieldChecker::in_mm(granule) + " (largest)",
      "set the ribs farther apart, or take granules of at most " + FieldChecker::in_mm(0.5 * gap) + " radius");
}

void check_across(FieldChecker& check, const ShearCell& test) {
  const double largest = largest_radius(test.grains);
  const double between = test.fill_height_m - test.lid_ribs.height_m - test.base_ribs.height_m;
  check.require(between > 0, "fill_height_m",
                "is " + FieldChecker::in_mm(test.fill_height_m) + ": the ribs of lid and base would meet",
                "fill the cell higher, or give lower ribs");
  const double narrow = std::min({test.length_m, test.width_m, between});
  if (!(between > 0)) return;
  check.require(narrow >= 2 * kGranulesAcross * largest, "grains.radius_m",
                "is " + FieldChecker::in_mm(largest) + " (largest), but the bed is only " +
                    FieldChecker::in_mm(narrow) + " across, between its ribs: one of a few granules says nothing " +
                    "about a continuum",
                "take granules of at most " + FieldChecker::in_mm(narrow / (2 * kGranulesAcross)) + " radius");
}

void check_shearing(FieldChecker& check, const ShearCell& test) {
  const double speed = test.shear_speedup * test.shear_speed_m_s;
  check_speed(check, test, "shear_speedup", "the base", speed, "give a slower base or a smaller shear_speedup");
  check_speed(check, test, "lid_speed_m_s", "the lid", test.lid_speed_m_s, "give a slower lid");
  const double number = inertial_number(test);
  check.require(!(number > kFastestInertial), "shear_speedup",
                "shears at an inertial number of " + FieldChecker::text(number) + ": the stress rises with the speed",
                "give at most " + FieldChecker::text(test.shear_speedup * kFastestInertial / number));
}

}  // namespace

double area_m2(const ShearCell& test) {
  return test.length_m * test.width_m;
}

double filled_volume_m3(const ShearCell& test) {
  return area_m2(test) * test.fill_height_m;
}

double even_pitch_m(const RibSizes& ribs, double length) {
  return length / std::max(1.0, std::round(length / ribs.pitch_m));
}

double inertial_number(const ShearCell& test) {
  const double rate = test.shear_speedup * test.shear_speed_m_s / test.fill_height_m;
  return rate * 2 * test.grains.radius_m * std::sqrt(test.bulk_density_kg_m3 / test.normal_stress_pa);
}

double grains_needed(const ShearCell& test) {
  return number_of_granules(test, poured_volume_m3(filled_volume_m3(test)));
}

Faults validate(const ShearCell& test) {
  FieldChecker check;
  check_specimen(check, test);
  check_dimensions(check, test, shear_dimensions);
  check_ribs(check, test, test.lid_ribs, "lid_ribs");
  check_ribs(check, test, test.base_ribs, "base_ribs");
  check_across(check, test);
  if (test.normal_stress_pa > 0 && test.fill_height_m > 0 && test.grains.radius_m > 0 && test.bulk_density_kg_m3 > 0)
    check_shearing(check, test);
  check_wall(check, test.tools, "tools");
  return check.take();
}

std::vector<ReadingKind> reading_kinds(const ShearCell& test) {
  constexpr int pressed = 0, sheared = 1;
  constexpr double solid = 0.9;        // of the cell; denser is impossible for a bed of grains
  constexpr double largest_ratio = 5;  // of shear and normal stress; friction gives up to 1, cohesion adds to it
  const double full_g = 1e3 * solid * test.bulk_density_kg_m3 * filled_volume_m3(test);
  const double fill_mm = 1e3 * test.fill_height_m, travel_mm = 1e3 * test.final_displacement_m;
  const ReadingRange mass{0, full_g}, share{0, 1}, height{0, 1.5 * fill_mm}, travel{0, travel_mm};
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
    ReadingKind{.name = "shear.steady_from_mm", .key = "", .measure = "", .stage = sheared, .possible = travel}};
  // clang-format on
}

}  // namespace pastefit
