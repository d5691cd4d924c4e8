#include <catch2/catch.hpp>
#include <cmath>

#include "calibrate/laboratory/test.h"

using namespace pastefit;

namespace {

/// A run that reads this, and whose heap is a box of this height, 0.2 m wide.
SeenRun box_heap(double height_m, double shift_mm = 0) {
  SeenRun run;
  run.packing = static_cast<std::uint64_t>(1e3 * height_m);
  run.readings.set("step1.lateral_shift_mm", shift_mm);
  run.readings.set("step1.height_mm", 1e3 * height_m);
  run.readings.set("step1.spread_mm", 200);
  run.outlines["step1"] = {-0.1, 0.01, std::vector<double>(21, height_m)};
  return run;
}

}  // namespace

TEST_CASE("the drawing of a heap has every heap, the mean of those that stand, and each length where it is measured") {
  const std::vector<SeenRun> runs{box_heap(0.10), box_heap(0.12), box_heap(0.05, 90)};
  const std::vector<Measurement> measured{{"step1.height_mm", 150, 7.5, 1}, {"step1.spread_mm", 310, 25, 1}};
  const auto drawings = drawings_of(Test(SlumpTest{}), runs, measured);
  REQUIRE(drawings.size() == 1);
  const Drawing& heap = drawings[0];
  CHECK(heap.to_scale);
  const auto heights_by = [&](DrawnBy by) {
    std::vector<double> heights;
    for (const DrawnLine& line : heap.lines)
      if (line.by == by) heights.push_back(std::round(line.points[line.points.size() / 2][1]));
    return heights;
  };
  CHECK(heights_by(DrawnBy::run) == std::vector<double>{100, 120});
  CHECK(heights_by(DrawnBy::rejected) == std::vector<double>{50});
  CHECK(heights_by(DrawnBy::simulation) == std::vector<double>{110});
  REQUIRE(heap.lengths.size() == 4);
  CHECK(heap.lengths[0].value == 150);
  CHECK(heap.lengths[0].deviation == 7.5);
  CHECK(heap.lengths[0].to[1] == 150);
  CHECK(heap.lengths[1].by == DrawnBy::simulation);
  CHECK(heap.lengths[1].to[1] == Approx(110));
  CHECK(heap.lengths[2].to[0] - heap.lengths[2].from[0] == Approx(310));
}

TEST_CASE("what the laboratory did not measure has no length in the drawing") {
  const std::vector<SeenRun> runs{box_heap(0.10)};
  CHECK(drawings_of(Test(SlumpTest{}), runs, {})[0].lengths.empty());
}

TEST_CASE("a test of two steps has a drawing of each heap") {
  SlumpTest test;
  test.drop.emplace();
  CHECK(drawings_of(Test(test), {}, {}).size() == 2);
}

TEST_CASE("the drawing of a pellet has the curves of its packings over the measured strength") {
  std::vector<SeenRun> runs(2);
  runs[0].curve = Curve{"stress_strain", "strain", "stress_pa", {{0.01, 100}, {0.02, 300}}};
  runs[1].curve = Curve{"stress_strain", "strain", "stress_pa", {{0.01, 200}, {0.02, 500}, {0.03, 400}}};
  const std::vector<Measurement> measured{{"pellet.dynamic_yield_strength_pa", 3000, 300, 1}};
  const auto drawings = drawings_of(Test(PelletCrush{}), runs, measured);
  REQUIRE(drawings.size() == 1);
  REQUIRE(drawings[0].bands.size() == 1);
  CHECK(drawings[0].bands[0].points == std::vector<std::array<double, 3>>{{0.01, 100, 200}, {0.02, 300, 500}});
  REQUIRE(drawings[0].lines.size() == 2);
  CHECK(drawings[0].lines[0].points == std::vector<DrawnPoint>{{0.01, 150}, {0.02, 400}});
  CHECK(drawings[0].lines[1].deviation == 300);
}

TEST_CASE("the drawing of a drop falls from its height and rises to the rebounds, on each plate") {
  DropTest test;
  test.drop_height_m = 0.5;
  test.plate_tilt_rad = 0.3;
  std::vector<SeenRun> runs(1);
  runs[0].readings.set("level.rebound_height_mm", 245);
  const std::vector<Measurement> measured{{"level.rebound_height_mm", 320, 5, 4}};
  const auto drawings = drawings_of(Test(test), runs, measured);
  REQUIRE(drawings.size() == 2);
  const auto& lines = drawings[0].lines;
  REQUIRE(lines.size() == 3);
  CHECK(lines[0].points.front()[1] == Approx(500));
  CHECK(lines[0].points.back()[1] == Approx(0).margin(1e-9));
  CHECK(lines[1].points.front()[0] == Approx(lines[0].points.back()[0]));
  CHECK(lines[1].points.front()[1] == Approx(0).margin(1e-9));
  CHECK(lines[1].points.back()[1] == Approx(320));
  CHECK(lines[2].points.back()[1] == Approx(245));
  CHECK(drawings[1].lines.size() == 1);
}
