#include "core/apparatus/slump/slump_test.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/apparatus/field_checker.h"
#include "core/world/world.h"

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

double fall_time_s(const DropPlate& plate) {
  const double fall_m = plate.motion == TableMotion::hinged
                            ? plate.length_m * std::asin(plate.lift_height_m / plate.length_m) / 1.5
                            : plate.lift_height_m;
  return std::sqrt(2 * fall_m / kGravity);
}

double moving_time_s(const DropPlate& plate) {
  return (plate.motion == TableMotion::hinged ? plate.lift_duration_s : 0) + fall_time_s(plate);
}

namespace {

void check_plate(FieldChecker& check, const SlumpTest& test) {
  const DropPlate& plate = *test.drop;
  check_dimensions(check, plate, plate_dimensions, "drop.");
  check_dimensions(check, plate, rhythm_dimensions, "drop.");
  check.range("drop.length_m", plate.length_m, 2 * wider_radius_m(test.mould), 10, "m");
  check.range("drop.lift_height_m", plate.lift_height_m, 1e-4, 0.99 * plate.length_m, "m");
  check.range("drop.drops", plate.drops, 1, kMostDrops, "");
  if (plate.drops == 1) return;
  const double moving_ms = std::ceil(1e3 * moving_time_s(plate));
  check.require(!(plate.period_s < 1e-3 * moving_ms), "drop.period_s",
                "is " + FieldChecker::text(plate.period_s) + " s, but the plate moves for " +
                    FieldChecker::text(1e-3 * moving_ms) + " s in every drop",
                "give at least " + FieldChecker::text(1e-3 * moving_ms) + " s" +
                    (plate.motion == TableMotion::hinged ? ", or a shorter lift_duration_s" : ""));
}

}  // namespace

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
  if (const auto& flow = test.reading.flow)
    check.range("reading.flow.diameter_m", flow->diameter_m, 2 * wider_radius_m(mould), test.table_length_m, "m");
  if (const auto& flank = test.reading.flank) {
    constexpr double kShortest = 0.1;
    check_dimensions(check, *flank, flank_dimensions, "reading.flank.");
    check.require(flank->upper_share - flank->lower_share >= kShortest, "reading.flank.upper_share",
                  "is " + FieldChecker::text(flank->upper_share) + ", less than 0.1 above lower_share, " +
                      FieldChecker::text(flank->lower_share),
                  "e.g. lower_share 0.2 and upper_share 0.8");
  }
  if (test.drop) {
    check_plate(check, test);
    if (test.drop->motion == TableMotion::hinged)
      check.range("reading.sag_window_m", test.reading.sag_window_m, 4 * radius, test.table_length_m, "m");
  }
  if (test.tilt) {
    check_dimensions(check, *test.tilt, tilt_dimensions, "tilt.");
    check.require(!test.drop, "tilt", "is of the heap of step 1, but the plate drops",
                  "describe two tests: one with the drop, one with the tilt");
  }
  check_wall(check, test.mould_wall, "mould_wall");
  check_wall(check, test.table_wall, "table_wall");
  return check.take();
}

}  // namespace pastefit
