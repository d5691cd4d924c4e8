#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "calibrate/laboratory/slump.h"

namespace pastefit {
namespace {

/// The Abrams cone.
SlumpTest abrams() {
  SlumpTest test;
  test.mould = {0.100, 0.050, 0.300};
  return test;
}

ReadingCheck doubts_about_heap(double height_mm, double width_mm, int repeats = 1) {
  const std::vector<Measurement> readings{{"step1.height_mm", height_mm, 7.5, repeats},
                                          {"step1.spread_mm", width_mm, 25, repeats}};
  return check_readings(abrams(), readings);
}

std::string note_on(double height_mm, double width_mm) {
  const ReadingCheck check = doubts_about_heap(height_mm, width_mm);
  REQUIRE(check.faults.empty());
  REQUIRE(check.remarks().size() == 1);
  return check.remarks()[0];
}

/// Width of a body of the mould's volume V = factor pi/4 D^2 h.
double width_of_body(double factor, double height_mm) {
  return std::sqrt(4e9 * volume_m3(abrams().mould) / (std::numbers::pi * factor * height_mm));
}

}  // namespace

TEST_CASE("the cone of the mould's volume and height is as wide as its formula says") {
  for (const double height_mm : {40.0, 150.0, 290.0})
    CHECK(cone_width_mm(abrams(), height_mm) == Approx(width_of_body(1.0 / 3, height_mm)));
}

TEST_CASE("a heap is told by the bodies between which it lies") {
  constexpr double height = 100;
  const double pancake = width_of_body(1, height), paraboloid = width_of_body(0.5, height),
               cone = width_of_body(1.0 / 3, height);
  CHECK_THAT(note_on(height, (pancake + paraboloid) / 2), Catch::Contains("between a flat cylinder and a paraboloid"));
  CHECK_THAT(note_on(height, (paraboloid + cone) / 2), Catch::Contains("between a paraboloid and a cone"));
  CHECK_THAT(note_on(height, pancake - 5), Catch::Contains("check the readings: no heap of this volume is"));
  CHECK_THAT(note_on(height, cone + 5), Catch::Contains("wider than a cone, by no more than"));
}

TEST_CASE("readings that only a heap with a skirt has are doubted, with the nearest cone") {
  // Mixes 20, 66 and 79 of Yeh's slump tests.
  const std::string note = note_on(150, 485);
  CHECK_THAT(note, Catch::Contains("no convex heap of this volume is 150 mm high and 485 mm wide (1.30"));
  CHECK_THAT(note, Catch::Contains("a peak on a skirt"));
  CHECK_THAT(note_on(90, 510), Catch::Contains("(1.06 +-") && Catch::Contains("wider than a cone, by no more"));
  CHECK_THAT(note_on(137.5, 310),
             Catch::Contains("(0.79 +-") && Catch::Contains("between a flat cylinder and a paraboloid"));

  double height = 0, width = 0;
  const std::string nearest = note.substr(note.find("can be, is ") + 11);
  REQUIRE(std::sscanf(nearest.c_str(), "%lf mm high and %lf mm wide", &height, &width) == 2);
  CHECK(width == Approx(cone_width_mm(abrams(), height)).epsilon(0.002));
  const auto difference = [](double at_mm) {
    return std::hypot((at_mm - 150) / 7.5, (cone_width_mm(abrams(), at_mm) - 485) / 25);
  };
  CHECK(difference(height) < difference(height - 1));
  CHECK(difference(height) < difference(height + 1));
}

TEST_CASE("a heap into which the mould's content does not fit is a fault that names both readings and the bound") {
  const double pancake = width_of_body(1, 70);
  CHECK(doubts_about_heap(70, pancake - 60).faults.empty());
  const Faults faults = doubts_about_heap(70, 210).faults;
  REQUIRE(faults.size() == 1);
  CHECK_THAT(faults[0].what, Catch::Contains("step1.height_mm (70)") && Catch::Contains("step1.spread_mm (210)"));
  CHECK_THAT(faults[0].what, Catch::Contains(std::to_string(static_cast<int>(std::round(pancake)))));
}

TEST_CASE("a heap that is too narrow is told what may have been taken for what") {
  CHECK_THAT(note_on(107, 236), Catch::Contains("if 236 mm is a radius, the width is 472 mm"));
  const std::vector<Measurement> swapped{{"step1.height_mm", 20, 2, 1}, {"step1.spread_mm", 200, 5, 1}};
  const Faults faults = check_readings(abrams(), swapped).faults;
  REQUIRE(faults.size() == 1);
  CHECK_THAT(faults[0].what, Catch::Contains("if 20 mm is a slump, the height is 280 mm"));
}

TEST_CASE("a slump of a few millimetres is told in other units") {
  const std::vector<Measurement> height{{"step1.height_mm", 292.75, 7.5, 1}};
  const auto doubts = check_readings(abrams(), height).doubts;
  REQUIRE(doubts.size() == 1);
  CHECK_THAT(doubts[0], Catch::Contains("7.25 cm are 72.5 mm, 7.25 in are 184.15 mm"));
}

TEST_CASE("an ordinary heap is no doubt, one that no body has is") {
  CHECK(doubts_about_heap(80, 400).doubts.empty());  // 0.78 of a cone's width
  CHECK(doubts_about_heap(107, 236).doubts.size() == 1);
  CHECK(doubts_about_heap(120, 500).doubts.size() == 1);
}

TEST_CASE("repeats make a contradiction sure") {
  const double narrow = width_of_body(1, 70) - 60;
  CHECK(doubts_about_heap(70, narrow).faults.empty());
  CHECK(doubts_about_heap(70, narrow, 9).faults.size() == 1);
}

TEST_CASE("one reading alone is not doubted") {
  const std::vector<Measurement> height{{"step1.height_mm", 150, 7.5, 1}};
  CHECK(check_readings(abrams(), height).remarks().empty());
  const std::vector<Measurement> mixed{{"step1.height_mm", 150, 7.5, 1}, {"step2.spread_mm", 485, 25, 1}};
  CHECK(check_readings(abrams(), mixed).remarks().empty());
}

}  // namespace pastefit
