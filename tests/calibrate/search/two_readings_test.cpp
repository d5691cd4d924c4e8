#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "calibrate/search/search.h"
#include "fake_slump.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

struct Heap {
  double height_mm, spread_mm;
};
// Concrete mixes 66, 79, 89, 04, 39, 85.
const std::vector<Heap> mixes{{90, 510}, {137.5, 310}, {205, 275}, {270, 215}, {110, 430}, {65, 525}};
constexpr double height_tolerance_mm = 7.5, spread_tolerance_mm = 25;  // of the fakes

/// Searches for several heaps, with several seeds each.
struct Campaign {
  std::vector<std::pair<Heap, Calibration>> searches;

  /// Share of them.
  double confirmed() const {
    const auto holds = [](const auto& one) { return one.second.status == CalibrationStatus::confirmed; };
    return static_cast<double>(std::ranges::count_if(searches, holds)) / static_cast<double>(searches.size());
  }

  int median_simulations() const {
    std::vector<int> simulations;
    for (const auto& [heap, found] : searches) simulations.push_back(found.simulations);
    std::ranges::sort(simulations);
    return simulations[simulations.size() / 2];
  }
};

Campaign search_all(const std::vector<Heap>& heaps, Synthetic (*fake)(double, double, std::uint64_t)) {
  Campaign campaign;
  for (const Heap& heap : heaps) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      Synthetic objective = fake(heap.height_mm, heap.spread_mm, seed);
      SearchOptions options = options_with(seed);
      options.budget_simulations = 150;
      options.confirmation_packings = 8;
      campaign.searches.emplace_back(heap, search(objective, options));
    }
  }
  return campaign;
}

}  // namespace

TEST_CASE("height and spread of real mixes are met together, each within its tolerance", "[campaign]") {
  const Campaign campaign = search_all(mixes, fake_heap);
  int right = 0;
  double simulations = 0;
  for (const auto& [mix, found] : campaign.searches) {
    simulations += found.simulations;
    if (found.status != CalibrationStatus::confirmed) continue;
    CHECK(std::abs(found.confirmation.readings[0] - mix.height_mm) <= height_tolerance_mm);
    CHECK(std::abs(found.confirmation.readings[1] - mix.spread_mm) <= spread_tolerance_mm);
    const auto [height, spread] = mean_heap(found.best.point);
    if (std::abs(height - mix.height_mm) <= height_tolerance_mm &&
        std::abs(spread - mix.spread_mm) <= spread_tolerance_mm)
      ++right;
  }
  const auto searches = static_cast<double>(campaign.searches.size());
  INFO("median of simulations " << campaign.median_simulations() << ", mean " << simulations / searches);
  CHECK(campaign.confirmed() >= 0.95);
  CHECK(right >= 0.9 * campaign.confirmed() * searches);
  CHECK(campaign.median_simulations() <= 30);
}

TEST_CASE("with priors on what two readings leave open, every seed recommends nearly the same there", "[campaign]") {
  constexpr double gap_15_percent = 0.047;  // bounds of 0.05 to 1 R, logarithmic
  const Heap mix = mixes[1];
  std::vector<double> gaps;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Synthetic objective = fake_heap(mix.height_mm, mix.spread_mm, seed);
    objective.known = [](const UnitPoint& x) {
      std::vector<double> off;
      for (const int open : {1, 2, 3, 4, 5, 6}) off.push_back((x[open] - 0.5) / 0.15);
      return off;
    };
    const Calibration found = search(objective, options_with(seed));
    CHECK(found.status == CalibrationStatus::confirmed);
    gaps.push_back(found.best.point[3]);
  }
  std::ranges::sort(gaps);
  const double median = (gaps[4] + gaps[5]) / 2;
  const auto agrees = [&](double gap) { return std::abs(gap - median) <= gap_15_percent; };
  CHECK(std::ranges::count_if(gaps, agrees) >= 9);  // 7 of the first acceptable candidates
}

TEST_CASE("where some materials stand or shear off by luck, those are confirmed whose packings agree", "[campaign]") {
  const Campaign campaign = search_all({mixes[1], mixes[2]}, brittle_heap);
  INFO("median of simulations " << campaign.median_simulations());
  CHECK(campaign.confirmed() >= 0.85);
}

TEST_CASE("a reading that is never 0, but within its tolerance of it, does not hold a search up", "[campaign]") {
  const Campaign campaign = search_all({mixes[1], mixes[5]}, shifting_heap);
  INFO("median of simulations " << campaign.median_simulations());
  CHECK(campaign.confirmed() >= 0.85);
  CHECK(campaign.median_simulations() <= 30);  // eight of them of the recommended candidate
}

TEST_CASE("a reading that is off by more than its tolerance is not made up for by one that is met") {
  Synthetic objective = fake_heap(110, 430, 1);
  objective.observe = [](const UnitPoint&, std::uint64_t) { return std::vector<double>{110, 430 + 1.2 * 25}; };
  const Calibration calibration = search(objective, options_with(1));
  CHECK(calibration.status != CalibrationStatus::confirmed);
  CHECK(calibration.best.error == Approx(1.2));
}

TEST_CASE("a reading within its tolerance is in reach, though every simulation reads more than the laboratory") {
  Synthetic objective = shifting_heap(110, 430, 1);
  objective.observe = [](const UnitPoint& x, std::uint64_t) {
    return std::vector<double>{110, 430 + (x[0] > 0.5 ? 1.5 : -1.5) * 25, 30};
  };
  const Calibration calibration = search(objective, options_with(1));
  CHECK(calibration.status == CalibrationStatus::unconfirmed);
  CHECK(calibration.reason.find("cannot reach") == std::string::npos);
}
