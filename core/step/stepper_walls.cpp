#include <algorithm>
#include <cmath>
#include <variant>

#include "core/step/stepper.h"

// Walls in a step: kernels of their contacts, loads on them, and their work.

namespace pastefit {

namespace {

Vec3 taken(const float (&rows)[3][kBatch], int lane) {
  return {rows[0][lane], rows[1][lane], rows[2][lane]};
}

}  // namespace

void Stepper::act_on_walls(int b, int member) {
  const Timed timed(options_.clock, StageClock::wall);
  for (std::size_t w = 0; w < world_.walls.size(); ++w)
    if (world_.pairs.blocks[b].walls[w].count > 0) act_on_wall(w, b, wall_batches_[member]);
}

void Stepper::act_on_wall(std::size_t w, int b, Column<WallBatch>& batches) {
  const Wall& wall = world_.walls[w];
  WallContacts& touching = world_.pairs.blocks[b].walls[w];
  WallShare& share = wall_shares_[b * world_.walls.size() + w];
  share.pierced = find_wall(wall, touching, batches);
  act_on(wall, touching, batches, task(wall.pair, b));
  add_loads(wall, touching, batches, share);
}

void Stepper::act_on(const Wall& wall, WallContacts& touching, Column<WallBatch>& batches, KernelTask task) const {
  task.contacts = touching.contacts.batches.data();
  task.wall = batches.data();
  task.stretch = {0, 0, touching.contacts.batch_count()};
  const BridgeShape attraction = wall.pair.bridge_c > 0 ? world_.attraction : BridgeShape::none;
  const Kernels& of_walls =
      wall.pair.viscosity > 0 && attraction != BridgeShape::none ? kernels_.viscous_wall : kernels_.wall;
  of_walls[combination(acting(world_.normal, wall.pair), attraction, world_.rolling)](task);
}

void Stepper::add_up_walls() {
  for (std::size_t w = 0; w < world_.walls.size(); ++w) {
    Wall& wall = world_.walls[w];
    wall.force = wall.torque = {};
    for (std::size_t at = w; at < wall_shares_.size(); at += world_.walls.size()) {
      const WallShare& share = wall_shares_[at];
      wall.force += share.force;
      wall.torque += share.torque;
      if (share.pierced >= 0) pierced_ = share.pierced;
    }
  }
}

/// Computes the nearest point of the wall and its velocity there; returns a grain that is too deep in it, or -1.
std::int32_t Stepper::find_wall(const Wall& wall, const WallContacts& touching, Column<WallBatch>& batches) const {
  batches.resize(std::max<std::size_t>(batches.size(), touching.contacts.batch_count()));
  const WallTask task{
      world_.particles.motion.data(), touching.contacts.batches.data(), batches.data(), touching.count, &wall,
      options_.overlap_limit};
  return std::visit(
      [&]<class Shape>(const Shape& shape) { return std::get<FindOnWall<Shape>>(kernels_.find_on_wall)(task, shape); },
      wall.shape);
}

/// Adds the kernel's results to the grains, and sums them up on the wall.
void Stepper::add_loads(const Wall& wall, const WallContacts& touching, const Column<WallBatch>& batches,
                        WallShare& sum) {
  for (std::int32_t k = 0; k < touching.count; ++k) {
    const WallBatch& batch = batches[k / kBatch];
    const int lane = k % kBatch;
    const std::int32_t i = touching.contacts.first(k);
    Load& load = world_.particles.load[i];
    const Vec3 force = taken(batch.force, lane);
    for (int c = 0; c < 3; ++c) {
      load.force[c] += batch.force[c][lane];
      load.torque[c] += batch.moment[c][lane];
    }
    load.damping += batch.damping[lane];
    // A wall does not move in response: half of what two equal grains count in the bound 2 sum(k)/m.
    load.stiffness += 0.5F * batch.stiffness[lane];
    sum.force += -force;
    const Motion& grain = world_.particles.motion[i];
    const Vec3 arm = grain.position + (grain.radius - batch.overlap[lane]) * taken(batch.normal, lane) - wall.pivot;
    sum.torque += cross(arm, -force);
  }
}

/// A force acts for half of the step before and half of the step after.
void Stepper::account_walls(double dt) {
  for (const Wall& wall : world_.walls) {
    const double before = dot(wall.force, wall.velocity_before) + dot(wall.torque, wall.angular_velocity_before);
    const double after = dot(wall.force, wall.velocity) + dot(wall.torque, wall.angular_velocity);
    energy_balance_.work_of_walls -= 0.5 * (dt_ * before + dt * after);
    energy_balance_.effort_of_walls += 0.5 * (dt_ * std::fabs(before) + dt * std::fabs(after));
  }
}

/// Energy stored in the contacts and bridges of a wall [J], from a step of zero length whose history is discarded.
double Stepper::held_by(std::size_t w) {
  const Wall& wall = world_.walls[w];
  std::vector<EnergySums> energy(1);
  for (std::size_t b = 0; b < world_.pairs.blocks.size(); ++b) {
    WallContacts touching = world_.pairs.blocks[b].walls[w];
    if (touching.count == 0) continue;
    find_wall(wall, touching, wall_batches_[0]);
    KernelTask asked = task(wall.pair, static_cast<int>(b));
    asked.dt = 0;
    asked.energy = energy.data();
    asked.energies = Energies::all;
    act_on(wall, touching, wall_batches_[0], asked);
  }
  return total(energy, EnergySums::stored);
}

void Stepper::lifted(double work_j) {
  energy_balance_.work_of_walls += work_j;
  energy_balance_.effort_of_walls += std::fabs(work_j);
  forget_lists();
}

void Stepper::take_away_last_wall() {
  if (options_.energy_balance) {
    const double held = held_by(world_.walls.size() - 1);
    energy_balance_.stored -= held;
    energy_balance_.work_of_walls -= held;
    energy_balance_.effort_of_walls += std::fabs(held);
  }
  world_.walls.pop_back();
  forget_lists();
}

}  // namespace pastefit
