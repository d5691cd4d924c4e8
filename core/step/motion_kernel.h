// Included once by each of kernels_{four_lanes,avx2,avx512}.cpp, which name the instruction set.
// Everything here lives in that namespace or is inlined: see core/laws/pack.h.

#include <algorithm>

#include "core/laws/pack.h"
#include "core/step/kernels.h"

namespace pastefit::PASTEFIT_ISA {

namespace {

/// A quarter or half of a grain's cache line as stored: a vector of three and the number next to it.
using Row = Doubles<4>;

PASTEFIT_INLINE Row row(double xyz, double beside) {
  return Row(Row::Lanes{xyz, xyz, xyz, beside});
}

/// The row's vector, with zero next to it.
PASTEFIT_INLINE Row vector_of(Row row) {
  return select(Row::Mask{-1, -1, -1, 0}, row, Row(0.0));
}

PASTEFIT_INLINE Row with_beside(Row row, double beside) {
  return select(Row::Mask{-1, -1, -1, 0}, row, Row(beside));
}

PASTEFIT_INLINE Row widened(const float* quad) {
  return Row(__builtin_convertvector(Singles<4>::load(quad).v, Row::Lanes));
}

PASTEFIT_INLINE void round(Row row, float* quad) {
  Singles<4>(__builtin_convertvector(row.v, Singles<4>::Lanes)).store(quad);
}

PASTEFIT_INLINE double dot_of_vectors(Row a, Row b) {
  const Row product = a * b;
  return product.v[2] + (product.v[1] + product.v[0]);
}

/// Squared lengths of the vectors of two rows.
PASTEFIT_INLINE Doubles<2> squares(Row a, Row b) {
  const Row x = a * a, y = b * b;
  const Doubles<2> first(__builtin_shufflevector(x.v, y.v, 0, 4)), second(__builtin_shufflevector(x.v, y.v, 1, 5));
  return first + second + Doubles<2>(__builtin_shufflevector(x.v, y.v, 2, 6));
}

/// The last grain with an impossible speed or one that is not a number; -1 if none.
std::int32_t find_runaway(const MoveTask& task) {
  std::int32_t found = -1;
  for (std::int32_t i = task.grains; i < task.grains_end; ++i) {
    const Vec3& v = task.velocity[i].linear;
    if (!(dot(v, v) <= kRunawaySpeed * kRunawaySpeed)) found = i;
  }
  return found;
}

/// Share of the stability of a step that the springs of a grain use: half of (w dt)^2/2 for a pair of equal grains,
/// with w^2 <= 2 sum(k)/m, where k counts a spin with 3.5 S_t, as for an isolated pair, instead of 2.5 as with many
/// contacts. At most half: the step always leaves room for dampers.
constexpr double kSpringShare = 0.5 * 2.5 / 3.5;
constexpr double kLeastRoom = 0.5;

/// Leapfrog: advances velocities from the half step before to the half step after, and positions by one step.
Moved move_grains(const MoveTask& task) {
  const Row fall(Row::Lanes{0, 0, task.kick * task.gravity, 0});
  const double kept = 1 / (1 + task.kick * task.drag);
  const Row kept_row = row(kept, 1), dt(task.dt), kick = row(task.kick, 1), kick_alone = row(task.kick, 0);
  const Row springs = row(0, kSpringShare * task.dt * task.dt), least = row(1, kLeastRoom);
  Doubles<2> largest(0.0);  // squares of the displacement since the lists were made (unused), and of the speed
  Doubles<2>::Mask within = largest <= Doubles<2>(0.0);
  Row stiffest(0.0);
  Moved moved;
  for (std::int32_t i = task.grains; i < task.grains_end; ++i) {
    Motion& motion = task.motion[i];
    double* const linear = &task.velocity[i].linear.x;
    double* const angular = &task.velocity[i].angular.x;
    Load& acting = task.load[i];
    const double inverse_mass = task.velocity[i].inverse_mass, inverse_inertia = task.velocity[i].inverse_inertia;
    const Row lightness(inverse_mass), load = widened(acting.torque);

    // Next to the torque is the stiffness; next to the velocity the damping rate, the sum of c over the mass and over
    // the margin of stability that the springs leave.
    const Row stiffness = lightness * load;
    stiffest = larger(stiffness, stiffest);
    const Row room = larger(Row(1.0) - springs * stiffness, least);
    const Row velocity_before = vector_of(Row::load(linear));
    const Row kicked = velocity_before + kick * lightness / room * widened(acting.force);
    const Row velocity_after = kept_row * (kicked - fall);
    const Row v = vector_of(velocity_after);
    with_beside(v, inverse_mass).store(linear);
    round(velocity_after, motion.velocity);
    const Row place = Row::load(&motion.position.x) + dt * v;
    place.store(&motion.position.x);

    const Row spin_before = vector_of(Row::load(angular));
    const Row w = kept_row * (spin_before + kick_alone * Row(inverse_inertia) * load);
    with_beside(w, inverse_inertia).store(angular);
    round(with_beside(w, motion.radius), motion.spin);

    acting = {};

    const Row allowed = widened(task.bounds[i].from);
    const Doubles<2> square = squares(place - allowed, v);
    const Doubles<2>::Lanes limits{allowed.v[3] * allowed.v[3], kRunawaySpeed * kRunawaySpeed};
    within &= square <= Doubles<2>(limits);
    largest = larger(square, largest);
    if (task.drag > 0) {
      const double rate = 0.5 * task.kick * task.drag;
      moved.dissipation_drag += rate / inverse_mass * dot_of_vectors(v, velocity_before + v) +
                                rate / inverse_inertia * dot_of_vectors(w, spin_before + w);
    }
  }
  moved.exceeded = within[0] == 0;
  if (within[1] == 0) moved.runaway = find_runaway(task);
  moved.fastest_square = largest.v[1];
  moved.stiffest = stiffest.v[3];
  return moved;
}

}  // namespace

}  // namespace pastefit::PASTEFIT_ISA
