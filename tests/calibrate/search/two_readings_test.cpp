#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "calibrate/search/strategy.h"
#include "fake_slump.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

struct Heap {
  double height_mm, spread_mm;
};
// Concrete mixes 66, 79, 89, 04, 39, 85.
constexpr std::array<Heap, 6> mixes{{{90, 510}, {137.5, 310}, {205, 275}, {270, 215}, {110, 430}, {65, 525}}};

}  // namespace

TEST_CASE("height and spread of real mixes are met together, each within its tolerance", "[campaign]") {
  constexpr int seeds = 8;
  int confirmed = 0, right = 0;
  std::vector<int> simulations;
  for (const Heap& mix : mixes) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Synthetic objective = fake_heap(mix.height_mm, mix.spread_mm, seed);
      SearchOptions options = options_with(seed);
      options.budget_simulations = 150;
      options.confirmation_packings = 8;
      const Calibration found = search(objective, options);
      simulations.push_back(found.simulations);
      if (found.status != CalibrationStatus::confirmed) continue;
      ++confirmed;
      CHECK(std::abs(found.confirmation.observables[0] - mix.height_mm) <= objective.tolerances[0]);
      CHECK(std::abs(found.confirmation.observables[1] - mix.spread_mm) <= objective.tolerances[1]);
      const auto [height, spread] = mean_heap(found.best.point);
      if (std::abs(height - mix.height_mm) <= objective.tolerances[0] &&
          std::abs(spread - mix.spread_mm) <= objective.tolerances[1])
        ++right;
    }
  }
  std::sort(simulations.begin(), simulations.end());
  INFO("median of simulations " << simulations[simulations.size() / 2] << ", mean "
                                << std::accumulate(simulations.begin(), simulations.end(), 0.0) /
                                       static_cast<double>(simulations.size()));
  CHECK(confirmed >= 0.95 * seeds * mixes.size());
  CHECK(right >= 0.9 * confirmed);
  CHECK(simulations[simulations.size() / 2] <= 30);
}

TEST_CASE("where some materials stand or shear off by luck, those are confirmed whose packings agree", "[campaign]") {
  constexpr int seeds = 8;
  int confirmed = 0, brittle = 0;
  std::vector<int> simulations;
  for (const Heap& mix : {mixes[1], mixes[2]}) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Synthetic objective = brittle_heap(mix.height_mm, mix.spread_mm, seed);
      SearchOptions options = options_with(seed);
      options.budget_simulations = 150;
      options.confirmation_packings = 8;
      const Calibration found = search(objective, options);
      simulations.push_back(found.simulations);
      if (found.status == CalibrationStatus::confirmed) ++confirmed;
      if (found.best.point[3] > 0.5) ++brittle;
    }
  }
  std::sort(simulations.begin(), simulations.end());
  INFO("median of simulations " << simulations[simulations.size() / 2] << ", brittle " << brittle);
  CHECK(confirmed >= 0.85 * static_cast<double>(simulations.size()));
}

TEST_CASE("a reading that is never 0, but within its tolerance of it, does not hold a search up", "[campaign]") {
  constexpr int seeds = 8;
  int confirmed = 0;
  std::vector<int> simulations;
  for (const Heap& mix : {mixes[1], mixes[5]}) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Synthetic objective = shifting_heap(mix.height_mm, mix.spread_mm, seed);
      SearchOptions options = options_with(seed);
      options.budget_simulations = 150;
      options.confirmation_packings = 8;
      const Calibration found = search(objective, options);
      simulations.push_back(found.simulations);
      if (found.status == CalibrationStatus::confirmed) ++confirmed;
    }
  }
  std::sort(simulations.begin(), simulations.end());
  INFO("median of simulations " << simulations[simulations.size() / 2] << ", most " << simulations.back());
  CHECK(confirmed >= 0.85 * static_cast<double>(simulations.size()));
  CHECK(simulations[simulations.size() / 2] <= 30);
}

TEST_CASE("a reading that is off by more than its tolerance is not made up for by one that is met") {
  Synthetic objective = fake_heap(110, 430, 1);
  objective.observe = [](const UnitPoint&, std::uint64_t) { return std::vector<double>{110, 430 + 1.2 * 25}; };
  const Calibration calibration = search(objective, options_with(1));
  CHECK(calibration.status != CalibrationStatus::confirmed);
  CHECK(calibration.best.miss == Approx(1.2));
}
