#include "calibrate/laboratory/sketch.h"

#include <algorithm>
#include <catch2/catch.hpp>

namespace pastefit {
namespace {

TEST_CASE("the sketch of a slump test is its heap as it came to rest") {
  SlumpTest slump;
  slump.grains.radius_m = 0.014;
  slump.contact.rolling = RollingModel::spring_dashpot;  // so that no grain rolls away, which the spread leaves out
  slump.contact.rolling_friction = slump.table_wall.rolling_friction = 0.5;
  const Test test = slump;
  Sketcher sketcher;
  RunOptions options;
  options.watch_interval_s = 0.002;
  options.watch = [&](const Snapshot& snapshot) {
    sketcher.see(test, snapshot);
    return true;
  };
  const Outcome outcome = simulate(test, options);
  const Sketch sketch = sketcher.sketch(outcome);
  CHECK(sketch.heap);
  REQUIRE(sketch.points.size() == 50);
  CHECK(std::ranges::is_sorted(sketch.points, {}, [](const auto& point) { return point[0]; }));
  double top_mm = 0;
  for (const auto& [x, z] : sketch.points) top_mm = std::max(top_mm, z);
  // A sketch is taken every 0.1 s, and the raw surface lies below the reading by the roughness of the packing.
  CHECK(top_mm == Approx(*outcome.readings.find("step1.height_max_mm")).margin(8));
  const double width_mm = sketch.points.back()[0] - sketch.points.front()[0];
  CHECK(width_mm == Approx(*outcome.readings.find("step1.spread_mm")).epsilon(0.25));
}

TEST_CASE("the sketch of a test that draws a curve is that curve, thinned") {
  Outcome outcome;
  Curve curve{"crush", "strain", "stress [Pa]", {}};
  for (int i = 0; i <= 500; ++i) curve.points.push_back({i / 1000.0, 1234.5678 * i});
  outcome.curve = curve;
  const Sketch sketch = Sketcher().sketch(outcome);
  CHECK_FALSE(sketch.heap);
  REQUIRE(sketch.points.size() <= 52);
  CHECK(sketch.points.back() == std::array{0.5, 617000.0});
}

TEST_CASE("a run of which nothing was seen has no sketch") {
  CHECK(Sketcher().sketch(Outcome{}).points.empty());
}

}  // namespace
}  // namespace pastefit
