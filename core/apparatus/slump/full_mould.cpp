#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/apparatus/slump/packing.h"
#include "core/observe/heap.h"
#include "core/step/runner.h"

namespace pastefit {

namespace {

constexpr double kCap = 0.6;          // [s] simulated time allowed for scaling the column
constexpr double kLook = 0.01;        // [s] between two changes of size
constexpr double kMostGrowth = 2e-3;  // per change of size
constexpr double kEven = 2e-4;        // remaining change of size at which the column fits: 0.06 % of the volume

void enlarge(Particles& grains, double k) {
  for (std::int32_t i = 0; i < grains.count(); ++i) {
    grains.motion[i].position = k * grains.motion[i].position;
    grains.motion[i].radius *= k;
  }
}

}  // namespace

Fit fit_of(const Mould& mould, const Particles& grains, double radius) {
  // Patches of the mould's side, each wide enough for one grain to touch it.
  const double field = 4 * radius;
  const int layers = std::max(1, static_cast<int>(mould.height_m / field));
  const int sectors = std::max(6, static_cast<int>(2 * std::numbers::pi * narrower_radius_m(mould) / field));
  const double slope = (mould.base_radius_m - mould.top_radius_m) / mould.height_m;
  std::vector<double> nearest(static_cast<std::size_t>(layers) * sectors, radius);
  for (std::int32_t i = 0; i < grains.count(); ++i) {
    const Vec3& p = grains.motion[i].position;
    const double room = mould.base_radius_m - slope * p.z - std::sqrt(p.x * p.x + p.y * p.y);
    const double turn = 0.5 + std::atan2(p.y, p.x) / (2 * std::numbers::pi);
    const int layer = std::clamp(static_cast<int>(p.z / mould.height_m * layers), 0, layers - 1);
    double& gap = nearest[layer * sectors + static_cast<int>(turn * sectors) % sectors];
    gap = std::min(gap, room / std::sqrt(1 + slope * slope) - grains.motion[i].radius);
  }
  const Disc top{0, 0, 2 * (mould.top_radius_m - radius)};
  return {mould.height_m - mean_height(grains, radius, top),
          std::accumulate(nearest.begin(), nearest.end(), 0.0) / static_cast<double>(nearest.size())};
}

Packing full_mould(const SlumpTest& test, const Packing& packing, const RunOptions& asked) {
  RunOptions options = asked;
  options.steps.energy_balance = false;  // the column is scaled, which is no work of the model
  options.steps.fixed_step_s.reset();    // applies to the test only
  World world = world_in_mould(test, packing);
  world.drag = kColumnDrag;  // cohesion acts on all grains at once
  Runner runner(world, options, rest_measure_of_heap);
  Packing full = packing;
  const Mould& mould = test.mould;
  const double width = mould.base_radius_m + mould.top_radius_m;
  double size = 1;
  int even = 0;  // consecutive checks that fit; after two the column has come to rest at its last size
  for (double waited = 0; even < 2; waited += kLook) {
    const PhaseLeft looks{even > 0 ? 0 : kLook, std::max(0.0, kCap - waited) + 2 * kLook};
    full.failure = runner.run({.name = "fill.settle", .after = looks}, kLook);
    if (full.failure) break;
    const Fit fit = fit_of(mould, world.particles, test.grains.radius_m * size);
    const double missing_height = (fit.roughness_m - packing.roughness_m) / mould.height_m;
    const double missing_width = 2 * (fit.gap_m - packing.gap_m) / width;
    const double missing = (missing_height + 2 * missing_width) / 3;
    even = std::fabs(missing) < kEven || waited > kCap ? even + 1 : 0;
    if (even > 0) continue;
    const double growth = std::clamp(missing, -kMostGrowth, kMostGrowth);
    enlarge(world.particles, 1 + growth);
    runner.changed();
    size *= 1 + growth;
  }
  full.solid_volume_m3 *= size * size * size;
  for (std::int32_t i = 0; i < world.particles.count(); ++i) {
    full.centres[i] = world.particles.motion[i].position;
    full.radii[i] = world.particles.motion[i].radius;
  }
  full.run = runner.summary();
  return full;
}

}  // namespace pastefit
