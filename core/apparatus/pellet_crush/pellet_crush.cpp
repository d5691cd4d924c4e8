#include "core/apparatus/pellet_crush/pellet_crush.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/apparatus/field_checker.h"
#include "core/apparatus/granules.h"

namespace pastefit {

namespace {

constexpr double kGranulesAcross = 6;  // smallest number of granules across a pellet that represents a continuum

}  // namespace

double area_m2(const PelletCrush& test) {
  return 0.25 * std::numbers::pi * test.die_diameter_m * test.die_diameter_m;
}

double filled_volume_m3(const PelletCrush& test) {
  return area_m2(test) * test.fill_height_m;
}

Faults validate(const PelletCrush& test) {
  FieldChecker check;
  check_specimen(check, test);
  check_dimensions(check, test, pellet_dimensions);
  check.require(test.pressed_height_m <= test.fill_height_m, "pressed_height_m",
                "is above the fill height: the punch would press nothing", "give pressed height <= fill height");
  const double largest = largest_radius(test.grains);
  const double narrow = std::min(test.die_diameter_m, test.pressed_height_m);
  check.require(narrow >= 2 * kGranulesAcross * largest, "grains.radius_m",
                "is " + FieldChecker::in_mm(largest) + " (largest), but the pellet is only " +
                    FieldChecker::in_mm(narrow) + " across: one of a few granules says nothing about a continuum",
                "take granules of at most " + FieldChecker::in_mm(narrow / (2 * kGranulesAcross)) + " radius");
  check_speed(check, test, "press_speedup", "the punch", test.press_speedup * test.punch_speed_m_s,
              "give a slower punch or a smaller press_speedup");
  check_speed(check, test, "platen_speed_m_s", "the platen", test.platen_speed_m_s, "give a slower platen");
  check_wall(check, test.tools, "tools");
  return check.take();
}

std::vector<ReadingKind> reading_kinds(const PelletCrush& test) {
  constexpr int pressed = 0, crushed = 1;
  constexpr double solid = 0.9;  // of the die; denser is impossible for a bed of grains
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
