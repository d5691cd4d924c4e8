#include "core/apparatus/slump/slump_test.h"

#include <algorithm>
#include <numbers>

#include "core/apparatus/field_checker.h"

namespace pastefit {

double volume_m3(const Mould& mould) {
  const double rb = mould.base_radius_m, rt = mould.top_radius_m;
  return std::numbers::pi * mould.height_m / 3 * (rb * rb + rb * rt + rt * rt);
}

double wider_radius_m(const Mould& mould) {
  return std::max(mould.base_radius_m, mould.top_radius_m);
}

double narrower_radius_m(const Mould& mould) {
  return std::min(mould.base_radius_m, mould.top_radius_m);
}

Faults validate(const SlumpTest& test) {
  FieldChecker check;
  check_specimen(check, test);
  const double radius = test.grains.radius_m, largest = largest_radius(test.grains);
  const Mould& mould = test.mould;
  check_dimensions(check, mould, mould_dimensions, "mould.");
  constexpr double kGrainsAcross = 2.5;
  const double narrow = std::min(narrower_radius_m(mould), mould.height_m / 2);
  check.require(narrow >= kGrainsAcross * largest, "grains.radius_m",
                "is " + FieldChecker::in_mm(largest) + " (largest), but the mould is only " +
                    FieldChecker::in_mm(2 * narrow) + " across: a mould of a few grains says nothing about a continuum",
                "take grains of at most " + FieldChecker::in_mm(narrow / kGrainsAcross) + " radius");
  check_dimensions(check, test, slump_dimensions);
  check.range("table_length_m", test.table_length_m, 2 * wider_radius_m(mould), 10, "m");
  check.range("reading.probe_diameter_m", test.reading.probe_diameter_m, radius, 2 * wider_radius_m(mould), "m");
  if (test.drop) {
    check_dimensions(check, *test.drop, plate_dimensions, "drop.");
    check.range("reading.sag_window_m", test.reading.sag_window_m, 4 * radius, test.table_length_m, "m");
    check.range("drop.length_m", test.drop->length_m, 2 * wider_radius_m(mould), 10, "m");
    check.range("drop.lift_height_m", test.drop->lift_height_m, 1e-4, 0.99 * test.drop->length_m, "m");
  }
  check_wall(check, test.mould_wall, "mould_wall");
  check_wall(check, test.table_wall, "table_wall");
  return check.take();
}

}  // namespace pastefit
