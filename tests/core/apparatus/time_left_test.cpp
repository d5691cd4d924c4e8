#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/apparatus/pellet_crush/pellet_crush.h"
#include "core/apparatus/slump/slump_test.h"
#include "tests/core/apparatus/soft_granules.h"

namespace pastefit {
namespace {

/// One pass through a phase, and what was said meanwhile of its end.
struct Pass {
  std::string phase;
  double last_s = 0, step_s = 0;
  double earliest_s = 0, latest_s = 1e9;  // strictest of all that was said
  double widest_s = 0;
};

std::vector<Pass> passes_of(const auto& test) {
  std::vector<Pass> passes;
  RunOptions options;
  options.watch_interval_s = 0;  // every step
  options.watch = [&](const Snapshot& snapshot) {
    if (passes.empty() || passes.back().phase != snapshot.phase || snapshot.time_s < passes.back().last_s)
      passes.push_back({std::string(snapshot.phase), snapshot.time_s});
    Pass& pass = passes.back();
    pass.step_s = std::max(pass.step_s, snapshot.time_s - pass.last_s);
    pass.last_s = snapshot.time_s;
    pass.earliest_s = std::max(pass.earliest_s, snapshot.time_s + snapshot.left.least_s);
    pass.latest_s = std::min(pass.latest_s, snapshot.time_s + snapshot.left.most_s);
    pass.widest_s = std::max(pass.widest_s, snapshot.left.most_s - snapshot.left.least_s);
    return true;
  };
  const Outcome outcome = simulate(test, options);
  INFO((outcome.failure ? outcome.failure->message : ""));
  REQUIRE_FALSE(outcome.failure);
  return passes;
}

/// To two steps: a phase was last seen before its last one, and ends with a whole one.
void check_ends(const std::vector<Pass>& passes) {
  for (const Pass& pass : passes) {
    INFO(pass.phase << " was last seen at " << pass.last_s << " s, said to end from " << pass.earliest_s << " to "
                    << pass.latest_s << " s");
    const double slack = 2 * pass.step_s;
    CHECK(pass.last_s > pass.earliest_s - slack);
    CHECK(pass.last_s < pass.latest_s + slack);
  }
}

double widest_of(const std::vector<Pass>& passes, const std::string& phase) {
  const auto found = std::ranges::find(passes, phase, &Pass::phase);
  REQUIRE(found != passes.end());
  return found->widest_s;
}

TEST_CASE("each phase of a slump in two steps ends when it was said to") {
  SlumpTest test;
  test.grains.radius_m = 0.012;
  test.lift_velocity_m_s = 0.2;
  test.drop = DropPlate{};
  const auto passes = passes_of(test);
  check_ends(passes);
  CHECK(widest_of(passes, "fill.strike") == 0);  // known to the step
  CHECK(widest_of(passes, "step2.raise") == 0);
  CHECK(widest_of(passes, "step1.rest") > 1);  // a heap rests when it does
  CHECK(widest_of(passes, "step1.rest") < 4);
}

TEST_CASE("each phase of a pellet's test ends when it was said to") {
  const auto passes = passes_of(small_pellet(1.0));
  check_ends(passes);
  CHECK(widest_of(passes, "crush") >= 0);
}

}  // namespace
}  // namespace pastefit
