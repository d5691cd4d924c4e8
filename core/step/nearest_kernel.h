// Included once by each of kernels_{four_lanes,avx2,avx512}.cpp, which name the instruction set and the pack's width.
// Everything here lives in that namespace or is inlined: see core/laws/pack.h.

#include "core/laws/pack.h"
#include "core/laws/transpose.h"
#include "core/step/kernels.h"
#include "core/world/nearest.h"

namespace pastefit::PASTEFIT_ISA {

namespace {

/// Number of grains in two packs of doubles.
constexpr int kFound = PASTEFIT_WIDTH;
using Found = Doubles<kFound / 2>;

/// Centres of the grains, and the radii stored next to these.
struct Spheres {
  BasicVec3<Found> centre;
  Found radius;
};

PASTEFIT_INLINE Spheres spheres(const WallTask& task, const std::int32_t* grain) {
  alignas(64) static constexpr double kOrigin[4] = {};
  const auto row = [&](int lane) { return &task.motion[grain[lane]].position.x; };
  Found columns[4];
  read_differences([](int) { return kOrigin; }, row, columns);
  return {{columns[0], columns[1], columns[2]}, columns[3]};
}

PASTEFIT_INLINE void put(const BasicVec3<Found> (&halves)[2], float (&rows)[3][kBatch], int lane) {
  narrow(halves[0].x, halves[1].x).store(rows[0] + lane);
  narrow(halves[0].y, halves[1].y).store(rows[1] + lane);
  narrow(halves[0].z, halves[1].z).store(rows[2] + lane);
}

/// Padding has no overlap with a wall.
PASTEFIT_INLINE void pad(WallBatch& batch, int lane) {
  for (int c = 0; c < 3; ++c) batch.normal[c][lane] = batch.wall_velocity[c][lane] = 0;
  batch.overlap[lane] = -1;
}

template <class Shape>
std::int32_t find_on_wall(const WallTask& task, const Shape& shape) {
  const Wall& wall = *task.wall;
  const auto pivot = in_lanes<Found>(wall.pivot), velocity = in_lanes<Found>(wall.velocity_before);
  const auto spin = in_lanes<Found>(wall.angular_velocity_before);
  std::int32_t pierced = -1;
  for (std::int32_t first = 0; first < task.count; first += kFound) {
    const int lane = first % kBatch;
    const std::int32_t* const grain = task.contacts[first / kBatch].i + lane;
    BasicVec3<Found> normal[2], moving[2];
    Found overlap[2];
    for (int half = 0; half < 2; ++half) {
      const int offset = half * kFound / 2;
      const auto [centre, radius] = spheres(task, grain + offset);
      const BasicNearest<Found> point = nearest_on(shape, centre);
      const BasicVec3<Found> arm = centre + point.distance * point.direction - pivot;
      normal[half] = point.direction;
      moving[half] = velocity + cross(spin, arm);
      overlap[half] = radius - point.distance;
      const auto too_deep = overlap[half] > Found(task.overlap_limit) * radius;
      if (any(too_deep))
        for (int k = 0; k < kFound / 2 && first + offset + k < task.count; ++k)
          if (too_deep[k] != 0) pierced = grain[offset + k];
    }
    WallBatch& batch = task.batches[first / kBatch];
    put(normal, batch.normal, lane);
    put(moving, batch.wall_velocity, lane);
    narrow(overlap[0], overlap[1]).store(batch.overlap + lane);
  }
  for (std::int32_t k = task.count; k % kBatch != 0; ++k) pad(task.batches[k / kBatch], k % kBatch);
  return pierced;
}

}  // namespace

}  // namespace pastefit::PASTEFIT_ISA
