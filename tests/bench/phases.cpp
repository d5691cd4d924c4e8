#include "tests/bench/phases.h"

#include <algorithm>
#include <ctime>

#include "tests/bench/ladder.h"

namespace pastefit {

std::vector<PhaseCost> phases_of(const std::string& scene, double radius_m, int packings) {
  std::vector<PhaseCost> phases;
  SlumpTest test = front_scene(scene, radius_m);
  for (int n = 1; n <= packings; ++n) {
    test.packing_seed = static_cast<std::uint64_t>(n);
    std::clock_t last = std::clock();
    double last_time = 0;
    RunOptions options;
    options.watch_interval_s = 1e-3;
    options.watch = [&](const Snapshot& snapshot) {
      auto phase = std::ranges::find(phases, snapshot.phase, &PhaseCost::phase);
      if (phase == phases.end()) phase = phases.insert(phases.end(), PhaseCost{std::string(snapshot.phase), 0, 0});
      const std::clock_t now = std::clock();
      // Every world has a clock of its own that begins at 0.
      phase->simulated_s += (snapshot.time_s - (snapshot.time_s < last_time ? 0 : last_time)) / packings;
      phase->cpu_s += static_cast<double>(now - last) / CLOCKS_PER_SEC / packings;
      last = now;
      last_time = snapshot.time_s;
      return true;
    };
    (void)simulate(test, options);
  }
  return phases;
}

}  // namespace pastefit
