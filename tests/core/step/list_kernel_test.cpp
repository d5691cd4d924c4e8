#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/step/kernels.h"
#include "core/world/selection.h"

namespace pastefit {

namespace {

constexpr double kMean = 0.01;  // radius [m]

/// Grains of 5 to 15 mm in a box, some three of them deep in each other.
Particles grains_in_box(std::uint64_t count) {
  const RandomStream random(7, "grains in a box");
  std::vector<Vec3> centres;
  std::vector<double> radii;
  for (std::uint64_t n = 0; n < 4 * count; n += 4) {
    centres.push_back({random.uniform(n, 0, 0.12), random.uniform(n + 1, 0, 0.12), random.uniform(n + 2, 0, 0.12)});
    radii.push_back(random.uniform(n + 3, 0.5 * kMean, 1.5 * kMean));
  }
  return make_particles(centres, radii, 2500);
}

double scale_of(const Motion& a, const Motion& b) {
  return 2 * a.radius * b.radius / ((a.radius + b.radius) * kMean);
}

/// The bits of a pair, one after the other, in doubles.
unsigned expected(const NearnessTask& task, std::int32_t i, std::int32_t j) {
  const Motion &a = task.motion[i], &b = task.motion[j];
  const double distance = norm(task.domain.minimum_image(a.position, b.position)), touch = a.radius + b.radius;
  const double near = touch + task.way[i] + task.way[j], scale = scale_of(a, b);
  unsigned bits = 0;
  if (distance < touch) bits |= 1U << nearness::touching;
  if (distance < near) bits |= 1U << nearness::near;
  const AttractionReach& reach = task.reach;
  if (reach.pull_off_gap > 0 && distance < near + reach.pull_off_gap * std::max(scale, 1.0))
    bits |= 1U << nearness::held;
  if (reach.rupture_gap > 0) {
    if (distance < near + std::min(reach.formation_gap, reach.rupture_gap) * scale) bits |= 1U << nearness::forming;
    if (distance < near + reach.rupture_gap * scale) bits |= 1U << nearness::bridged;
  }
  return bits;
}

}  // namespace

TEST_CASE("every instruction set finds how near candidates are as one after the other they are") {
  const Particles grains = grains_in_box(60);
  std::vector<float> way;
  for (std::int32_t i = 0; i < grains.count(); ++i) way.push_back(static_cast<float>(1e-4 * (i % 20)));
  std::vector<std::int32_t> first;
  std::vector<NeighbourList::Pair> pairs;
  for (std::int32_t i = 0; i < grains.count(); ++i)
    for (std::int32_t j = i + 1; j < grains.count(); ++j) {
      first.push_back(i);
      pairs.emplace_back(j, static_cast<NeighbourList::Kept>((i + j) % NeighbourList::kinds));
    }
  pairs.pop_back();  // the last pack is not full
  REQUIRE(pairs.size() % 16 != 0);
  const AttractionReach reaches[] = {{}, {0.002, 0.008, 0, kMean}, {0.02, 0.008, 0, kMean}, {0, 0, 0.003, kMean}};
  for (const KernelTable* kernels : kernels_this_processor_runs())
    for (const Domain& domain : {Domain{}, Domain{0.12}})
      for (const AttractionReach& reach : reaches) {
        CAPTURE(kernels->instruction_set, domain.period, reach.rupture_gap, reach.formation_gap, reach.pull_off_gap);
        std::vector<std::uint8_t> found(pairs.size());
        const NearnessTask task{grains.motion.data(), way.data(), first.data(), pairs, domain, reach, found.data()};
        const Deepest deepest = kernels->find_nearness(task);
        double overlap = 0;
        std::size_t near = 0, wrong = 0;
        for (std::size_t k = 0; k < pairs.size(); ++k) {
          const std::int32_t i = first[k], j = pairs[k].grain();
          const unsigned bits = expected(task, i, j);
          if (found[k] != (bits | pairs[k].kept() << nearness::kept)) ++wrong;
          if (bits != 0) ++near;
          const Motion &a = grains.motion[i], &b = grains.motion[j];
          const double distance = norm(domain.minimum_image(a.position, b.position));
          overlap = std::max(overlap, (a.radius + b.radius - distance) / std::min(a.radius, b.radius));
        }
        CHECK(wrong == 0);
        CHECK(near > 30);
        CHECK(near < pairs.size() / 2);
        CHECK(deepest.overlap == Approx(overlap).epsilon(1e-12));
        CHECK(deepest.grain >= 0);
      }
}

TEST_CASE("every instruction set finds the grains of a vicinity as one after the other they are near") {
  constexpr double kFarthest = 0.4, kSkin = 0.008;
  const Particles grains = grains_in_box(300);
  for (const KernelTable* kernels : kernels_this_processor_runs())
    for (const Domain& domain : {Domain{}, Domain{0.12}})
      for (const std::int32_t others : {1, 7, 16, 33, 300}) {
        CAPTURE(kernels->instruction_set, domain.period, others);
        Vicinity vicinity(grains, domain, kFarthest, kSkin, kernels->find_near);
        vicinity.gather(0, others);
        for (const std::int32_t from : {0, 3}) {
          std::vector<std::int32_t> found, least, most;
          vicinity.find(150, from, [&](std::int32_t j) { found.push_back(j); });
          for (std::int32_t j = from; j < others; ++j) {
            const Motion &a = grains.motion[150], &b = grains.motion[j];
            const double range = a.radius + b.radius + kFarthest * kMean * scale_of(a, b) + kSkin;
            const double distance = norm(domain.minimum_image(a.position, b.position));
            if (distance < range) least.push_back(j);
            if (distance < range + 1e-6) most.push_back(j);
          }
          CHECK(least == most);  // none so near to the end of the range that rounding could tell
          CHECK(found == least);
        }
      }
}

}  // namespace pastefit
