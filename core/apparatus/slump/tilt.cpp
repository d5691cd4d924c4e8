#include "core/apparatus/slump/tilt.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/apparatus/slump/packing.h"
#include "core/observe/heap.h"
#include "core/step/runner.h"

namespace pastefit {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kStepsBetweenLooks = 16;  // between two looks at the base

/// The grains of a heap that lie on the table.
class Base {
 public:
  Base(const Particles& grains, const Vec3& pivot) : pivot_(pivot), belongs_(grains.count(), false) {
    for (std::int32_t i = 0; i < grains.count(); ++i)
      belongs_[grains.identity[i]] = grains.motion[i].position.z < 2 * grains.motion[i].radius;
    at_first_ = along_table(grains, 0);
  }

  /// Mean motion down the table, which is tilted by this angle [m].
  double slid_m(const Particles& grains, double angle) const { return at_first_ - along_table(grains, angle); }

 private:
  double along_table(const Particles& grains, double angle) const {
    double sum = 0;
    int count = 0;
    for (std::int32_t i = 0; i < grains.count(); ++i) {
      if (!belongs_[grains.identity[i]]) continue;
      const auto& place = grains.motion[i].position;
      sum += std::cos(angle) * (place.x - pivot_.x) + std::sin(angle) * (place.z - pivot_.z);
      ++count;
    }
    return count > 0 ? sum / count : 0;
  }

  Vec3 pivot_;
  std::vector<bool> belongs_;  ///< by identity
  double at_first_ = 0;
};

}  // namespace

Outcome tilt_table(const SlumpTest& test, const World& rested, const EnergyBalance& before, const RunOptions& options) {
  World world = rested;
  Runner runner(world, options, rest_measure_of_heap);
  runner.follow(before);
  Wall& table = world.walls[kTable];
  table.pivot = {-0.5 * test.table_length_m, 0, 0};
  const double rate = kDegree * test.tilt->rate_deg_s, start_s = world.time;
  const Base base(world.particles, table.pivot);
  const auto angle = [&] { return rate * (world.time - start_s); };
  const auto turn = [&](World&, double) { table.angular_velocity = {0, -rate, 0}; };  // positive lowers the free edge
  const auto slides = [&](const World& now) {
    return now.step % kStepsBetweenLooks == 0 && base.slid_m(now.particles, angle()) > test.tilt->slide_m;
  };
  Outcome outcome;
  outcome.failure = runner.run({"tilt", turn, slides}, kDegree * kSteepest / rate);
  if (!outcome.failure) outcome.failure = runner.show("tilt");
  if (!outcome.failure) outcome.readings.set("tilt.slide_angle_deg", angle() / kDegree);
  outcome.run = runner.summary();
  outcome.run.simulated_s -= start_s;
  outcome.run.settled = true;
  return outcome;
}

}  // namespace pastefit
