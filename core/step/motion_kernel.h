// Included once by each of kernels_{sse2,avx2,avx512}.cpp, which name the instruction set.
// Everything here lives in that namespace or is inlined: see core/laws/pack.h.

#include <algorithm>

#include "core/laws/pack.h"
#include "core/step/kernels.h"

namespace pastefit::PASTEFIT_ISA {

namespace {

/// A quarter or half of a grain's line as it lies in memory: a vector of three and a number beside it.
using Row = Pack<4>;

PASTEFIT_INLINE Row row(double xyz, double beside) {
  return Row(Row::Lanes{xyz, xyz, xyz, beside});
}

/// The row's vector, and nothing beside it whatever was there.
PASTEFIT_INLINE Row vector_of(Row row) {
  return select(Row::Mask{-1, -1, -1, 0}, row, Row(0.0));
}

PASTEFIT_INLINE double dot_of_vectors(Row a, Row b) {
  const Row product = a * b;
  return product.v[2] + (product.v[1] + product.v[0]);
}

/// Of the stability of a step, what the springs of a grain take: half of (w dt)^2/2 for a pair of grains alike, with
/// w^2 <= 2 sum(k)/m, where k counts a spin with 3.5 S_t, as for a pair alone, and not with 2.5 as among many. No more
/// than half: a step is chosen so that there is always room for dampers.
constexpr double kSpringShare = 0.5 * 2.5 / 3.5;
constexpr double kLeastRoom = 0.5;

/// Leapfrog: kicks velocities from the half step before to the half step after, and moves positions by a step.
Moved move_grains(const MoveTask& task) {
  const Row fall(Row::Lanes{0, 0, task.kick * task.gravity, 0});
  const double kept = 1 / (1 + task.kick * task.drag);
  const Row kept_row = row(kept, 1), dt(task.dt);
  Moved moved;
  for (std::int32_t i = task.grains; i < task.grains_end; ++i) {
    double* const position = &task.motion[i].position.x;
    double* const velocity = &task.motion[i].velocity.x;
    double* const spin = &task.spin[i].velocity.x;
    double* const force = &task.load[i].force.x;
    double* const torque = &task.load[i].torque.x;
    const double lightness = task.spin[i].inverse_mass, radius = task.motion[i].radius;
    const double inverse_inertia = 2.5 * lightness / (radius * radius);

    // Beside the velocity its damping rate, the sum of c over the mass and over the room that the springs leave.
    const Row load = Row::load(torque);
    const double room = std::max(1 - kSpringShare * task.dt * task.dt * lightness * load.v[3], kLeastRoom);
    const Row velocity_before = vector_of(Row::load(velocity));
    const Row kicked = velocity_before + row(task.kick * lightness, lightness / room) * Row::load(force);
    const Row velocity_after = kept_row * (kicked - fall);
    velocity_after.store(velocity);
    const Row v = vector_of(velocity_after);
    const Row place = Row::load(position) + dt * v;
    place.store(position);

    const Row spin_before = Row::load(spin);
    const Row spin_after = kept_row * (spin_before + row(task.kick * inverse_inertia, 0) * vector_of(load));
    spin_after.store(spin);

    Row(0.0).store(force);
    Row(0.0).store(torque);

    const Row way = place - Row::load(&task.rooms[i].from.x);
    const double distance = task.rooms[i].distance;
    moved.strayed |= !(dot_of_vectors(way, way) <= distance * distance);
    const double square = dot_of_vectors(v, v);
    if (!(square < kRunawaySpeed * kRunawaySpeed)) moved.runaway = i;
    moved.fastest_square = std::max(moved.fastest_square, square);
    moved.stiffest = std::max(moved.stiffest, load.v[3] * lightness);
    if (task.drag > 0) {
      const double rate = 0.5 * task.kick * task.drag;
      moved.heat_drag += rate / lightness * dot_of_vectors(v, velocity_before + v) +
                         rate / inverse_inertia * dot_of_vectors(spin_after, spin_before + spin_after);
    }
  }
  return moved;
}

}  // namespace

}  // namespace pastefit::PASTEFIT_ISA
