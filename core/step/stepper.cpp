#include "core/step/stepper.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/step/state.h"
#include "core/world/nearest.h"

namespace pastefit {

namespace {

constexpr double kSmallestShare = 1e-4;  // of the first step; a healthy run stays within a factor of ten

void put(const Vec3& v, float (&rows)[3][kBatch], int lane) {
  rows[0][lane] = static_cast<float>(v.x);
  rows[1][lane] = static_cast<float>(v.y);
  rows[2][lane] = static_cast<float>(v.z);
}

Vec3 taken(const float (&rows)[3][kBatch], int lane) {
  return {rows[0][lane], rows[1][lane], rows[2][lane]};
}

double speed_of(const Wall& wall) {
  // The farthest point of a turning wall is not known here; walls that turn are plates of at most a few metres.
  double reach = 0;
  if (const auto* plate = std::get_if<Plate>(&wall.shape))
    reach = norm(plate->centre - wall.pivot) + plate->half_length + plate->half_width;
  return norm(wall.velocity) + norm(wall.angular_velocity) * reach;
}

double stiffest_grain(const Particles& particles) {
  double stiffest = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i)
    stiffest = std::max(stiffest, particles.load[i].stiffness * particles.velocity[i].inverse_mass);
  return stiffest;
}

/// What the overlaps of all contacts hold [J].
double elastic_energy(const World& world) {
  const auto held = [&](const PairConstants& pair, double sqrt_radius, double overlap) {
    return with_law(NormalLaws{}, acting(world.normal, pair), [&](auto law) {
      const NormalForce<double> normal_force = law.at(pair, sqrt_radius, std::max(overlap, 0.0), 0.0);
      double energy = law.energy(pair, sqrt_radius * sqrt_radius, normal_force, overlap);
      if constexpr (law.adheres) energy += law.surface(pair, sqrt_radius * sqrt_radius, normal_force.contact_radius);
      return energy;
    });
  };
  double sum = 0;
  for (const Block& block : world.pairs.blocks)
    for (std::int32_t k = 0; k < block.contacts.count; ++k) {
      const std::int32_t i = block.contacts.first(k), j = block.contacts.second(k);
      if (i == j) continue;  // padding
      const Motion &a = world.particles.motion[i], &b = world.particles.motion[j];
      const double overlap = a.radius + b.radius - norm(world.domain.minimum_image(a.position, b.position));
      sum += held(world.grain_pair, block.contacts.sqrt_radius(k), overlap);
    }
  for (const Block& block : world.pairs.blocks)
    for (std::size_t w = 0; w < block.walls.size(); ++w)
      for (std::int32_t k = 0; k < block.walls[w].count; ++k) {
        const Motion& grain = world.particles.motion[block.walls[w].contacts.first(k)];
        const double overlap = grain.radius - nearest(world.walls[w].shape, grain.position).distance;
        sum += held(world.walls[w].pair, block.walls[w].contacts.sqrt_radius(k), overlap);
      }
  return sum;
}

}  // namespace

Stepper::Stepper(World& world, const StepOptions& options)
    : world_(world),
      options_(options),
      kernels_(options.kernels ? *options.kernels : kernels_of_this_processor()),
      pool_(options.threads),
      sleepers_(options.sleep ? std::make_optional<Sleepers>() : std::nullopt),
      lists_(world, options.skin * world.reference_radius, pool_, sleepers_ ? &*sleepers_ : nullptr, options.clock),
      wall_batches_(pool_.size()) {
  smallest_radius_ = smallest_mass_ = 1e300;
  for (std::int32_t i = 0; i < world.particles.count(); ++i) {
    smallest_radius_ = std::min(smallest_radius_, world.particles.motion[i].radius);
    smallest_mass_ = std::min(smallest_mass_, world.particles.mass(i));
    fastest_ = std::max(fastest_, norm(world.particles.velocity[i].linear));
  }
}

std::optional<Failure> Stepper::step(const std::function<void(World&, double)>& drive) {
  if (auto problem = maintain_lists()) return problem;
  // All forces before any grain moves: for the first step, which follows from them, and for the energy_balance. Else a
  // block is moved while it is in a cache: a tenth faster in a bed too large for it.
  const bool first = dt_ == 0, forces_first = first || looks_at_energy();
  double dt = first ? 0 : next_step();
  compute_forces(forces_first ? std::nullopt : std::make_optional(dt));
  if (pierced_ >= 0)
    return failure(
        FailureReason::grain_lost, world_.particles.identity[pierced_], options_.overlap_limit, options_.overlap_limit,
        "a grain is pressed into a wall by more than the allowed share of its radius; take stiffer grains or a "
        "smaller step");
  if (first) {
    stiffest_ = stiffest_grain(world_.particles);
    dt = next_step();
  }
  if (dt < kSmallestShare * time_step_.first() && !options_.fixed_step_s)
    return failure(FailureReason::step_collapse, -1, dt, kSmallestShare * time_step_.first(),
                   "the stable time step shrinks without end; take softer grains, less cohesion or a slower lift");
  if (drive) drive(world_, dt);
  if (options_.energy_balance) {
    account_walls(dt);
    look_at_energy(dt);
  }
  if (forces_first) pool_.each(static_cast<int>(world_.pairs.blocks.size()), [&](int b, int) { move_block(b, dt); });
  note_moved();
  for (Wall& wall : world_.walls) move(wall, dt);
  world_.time += dt;
  ++world_.step;
  dt_ = dt;
  return {};
}

void Stepper::check_state() const {
  lists_.check_state();
  if (sleepers_) sleepers_->check_state(world_, lists_.hold());
  demand(dt_ >= 0 && fastest_ >= 0 && fastest_ <= kRunawaySpeed && stiffest_ >= 0 && time_step_.is_sound(),
         "a time step, a speed or a stiffness is below nothing, or beyond any");
  demand(pierced_ == -1 && runaway_ == -1, "the run has failed");
  for (const EnergySums& energy : energy_) demand(energy.is_finite(), "an energy is not finite");
}

std::optional<Failure> Stepper::maintain_lists() {
  double fastest_wall = 0;
  for (const Wall& wall : world_.walls) fastest_wall = std::max(fastest_wall, speed_of(wall));
  if (runaway_ >= 0) {
    const double speed = norm(world_.particles.velocity[runaway_].linear);
    const bool finite = std::isfinite(speed);
    return failure(finite ? FailureReason::runaway_speed : FailureReason::non_finite,
                   world_.particles.identity[runaway_], finite ? speed : 0, kRunawaySpeed,
                   finite
                       ? "a grain is faster than anything in the test can make it; take a smaller step or less stiff "
                         "or less cohesive grains"
                       : "a velocity is not a number; take a smaller step");
  }
  const Deepest deepest = lists_.update(dt_, fastest_wall * dt_, fastest_wall);
  if (deepest.overlap > options_.overlap_limit)
    return failure(FailureReason::excessive_overlap, world_.particles.identity[deepest.grain], deepest.overlap,
                   options_.overlap_limit,
                   "two grains overlap by more than the allowed share of a radius; stiffer grains or less cohesion");
  return {};
}

/// Follows, but for the first one, from the stiffness and the speeds of the step before: they are known from moving the
/// grains, and safety has room for it.
double Stepper::next_step() {
  const double advised =
      time_step_.next(advised_step(world_, {smallest_radius_, smallest_mass_, fastest_, stiffest_}, options_));
  return options_.fixed_step_s.value_or(advised);
}

void Stepper::compute_forces(std::optional<double> dt) {
  const std::size_t blocks = world_.pairs.blocks.size();
  if (energy_.size() < blocks) energy_.resize(blocks);
  for (EnergySums& energy : energy_) energy.forget(EnergySums::stored);
  wall_shares_.assign(blocks * world_.walls.size(), {});
  moved_.assign(blocks, {});
  in_two_rounds(
      pool_, static_cast<int>(blocks), [&](int b, int) { act_on_pairs(b); },
      [&](int b, int member) {
        act_on_walls(b, member);
        if (sleepers_ && sleepers_->balance(world_, b)) lists_.note_exceeded(b);
        if (dt) move_block(b, *dt);
      });
  add_up_walls();
}

KernelTask Stepper::task(const PairConstants& pair, int block) {
  KernelTask task{};
  task.motion = world_.particles.motion.data();
  task.load = world_.particles.load.data();
  task.domain = world_.domain;
  task.pair = pair;
  task.dt = dt_;
  task.energy = &energy_[block];
  task.energies = looks_at_energy() ? Energies::all : options_.energy_balance ? Energies::dissipation : Energies::none;
  return task;
}

void Stepper::act_on_pairs(int b) {
  const Kernel pairs =
      kernels_.pair[combination(acting(world_.normal, world_.grain_pair), world_.attraction, world_.rolling)];
  const Kernel bridges = kernels_.bridge[row_of(world_.attraction)];
  Block& block = world_.pairs.blocks[b];
  KernelTask mine = task(world_.grain_pair, b);
  mine.contacts = block.contacts.batches.data();
  mine.stretch = {0, block.contacts.near / kBatch, block.contacts.awake / kBatch};
  {
    const Timed timed(options_.clock, StageClock::pair);
    pairs(mine);
  }
  mine.bridges = block.bridges.batches.data();
  mine.stretch = {0, 0, block.bridges.awake / kBatch};
  if (block.bridges.awake > 0) {
    const Timed timed(options_.clock, StageClock::bridge);
    bridges(mine);
  }
  if (sleepers_) sleepers_->hold(world_, b, mine, pairs, bridges);
}

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
  kernels_.wall[combination(acting(world_.normal, wall.pair), attraction, world_.rolling)](task);
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

/// Where the wall is and how it moves there; a grain that is too deep in it, or -1.
std::int32_t Stepper::find_wall(const Wall& wall, const WallContacts& touching, Column<WallBatch>& batches) const {
  batches.resize(std::max<std::size_t>(batches.size(), touching.contacts.batch_count()));
  WallBatch& padded = batches[touching.contacts.batch_count() - 1];
  padded = {};
  for (float& overlap : padded.overlap) overlap = -1;
  std::int32_t pierced = -1;
  const auto find = [&](const auto& shape) {
    for (std::int32_t k = 0; k < touching.count; ++k) {
      WallBatch& batch = batches[k / kBatch];
      const int lane = k % kBatch;
      const Motion& grain = world_.particles.motion[touching.contacts.first(k)];
      const Nearest point = nearest_on(shape, grain.position);
      const double overlap = grain.radius - point.distance;
      if (overlap > options_.overlap_limit * grain.radius) pierced = touching.contacts.first(k);
      const Vec3 arm = grain.position + point.distance * point.direction - wall.pivot;
      put(point.direction, batch.normal, lane);
      put(wall.velocity_before + cross(wall.angular_velocity_before, arm), batch.wall_velocity, lane);
      batch.overlap[lane] = static_cast<float>(overlap);
    }
  };
  std::visit(find, wall.shape);
  return pierced;
}

/// What the kernel found, on the grains, and summed up on the wall.
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
    // A wall does not give way: half of what two equal grains would count in the bound 2 sum(k)/m.
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

/// What the contacts and bridges of a wall hold now [J]. They are asked in a step of no length, whose history is thrown
/// away.
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

/// Energies at the time of the positions: the velocities there are the means of the half steps around it.
void Stepper::look_at_energy(double dt) {
  const Particles& particles = world_.particles;
  const double half_kick = 0.25 * (dt_ + dt);
  if (!looks_at_energy()) return;
  energy_balance_.kinetic = energy_balance_.height = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Motion& motion = particles.motion[i];
    const Load& load = particles.load[i];
    const Velocity& velocity = particles.velocity[i];
    const double m = 1 / velocity.inverse_mass, inertia = 1 / velocity.inverse_inertia;
    Vec3 v = velocity.linear + (half_kick / m) * vector_of(load.force);
    v.z -= half_kick * world_.gravity;
    const Vec3 w = velocity.angular + (half_kick / inertia) * vector_of(load.torque);
    energy_balance_.kinetic += 0.5 * (m * dot(v, v) + inertia * dot(w, w));
    energy_balance_.height += m * world_.gravity * motion.position.z;
  }
  energy_balance_.stored = total(energy_, EnergySums::stored);
  energy_balance_.dissipation_normal = total(energy_, EnergySums::normal_damping);
  energy_balance_.dissipation_sliding = total(energy_, EnergySums::sliding);
  energy_balance_.dissipation_rolling = total(energy_, EnergySums::rolling);
  energy_balance_.dissipation_bridges = total(energy_, EnergySums::bridges);
  if (sleepers_) sleepers_->enter(energy_balance_);
  if (looked_) return;
  looked_ = true;
  energy_balance_.start = energy_balance_.mechanical() + energy_balance_.dissipation() - energy_balance_.work_of_walls;
  energy_balance_.start_height = energy_balance_.height;
  if (energy_balance_.earlier_put_in > 0) return;
  energy_balance_.start_kinetic = energy_balance_.kinetic;
  energy_balance_.start_elastic = elastic_energy(world_);
}

void Stepper::follow(const EnergyBalance& before) {
  energy_balance_.earlier_error = before.error();
  energy_balance_.earlier_put_in = before.put_in();
}

void Stepper::move_block(int b, double dt) {
  const Timed timed(options_.clock, StageClock::move);
  Particles& particles = world_.particles;
  const Block& block = world_.pairs.blocks[b];
  moved_[b] = kernels_.move({particles.motion.data(), particles.velocity.data(), particles.load.data(), lists_.bounds(),
                             block.grains, block.grains_end, dt, 0.5 * (dt_ + dt), world_.gravity, world_.drag});
  if (moved_[b].exceeded) lists_.note_exceeded(b);
}

/// What the moved grains of all blocks have in common; the dummies' loads are used up like theirs.
void Stepper::note_moved() {
  Particles& particles = world_.particles;
  stiffest_ = 0;
  double fastest_square = 0;
  for (const Moved& moved : moved_) {
    fastest_square = std::max(fastest_square, moved.fastest_square);
    stiffest_ = std::max(stiffest_, moved.stiffest);
    energy_balance_.dissipation_drag += moved.dissipation_drag;
    if (moved.runaway >= 0) runaway_ = moved.runaway;
  }
  fastest_ = std::sqrt(fastest_square);
  for (std::size_t d = particles.count(); d < particles.load.size(); ++d) particles.load[d] = {};
}

Failure Stepper::failure(FailureReason reason, std::int64_t grain, double value, double limit,
                         std::string message) const {
  Failure f;
  f.reason = reason;
  f.step = world_.step;
  f.time_s = world_.time;
  f.grain = grain;
  f.value = value;
  f.limit = limit;
  f.message = std::move(message);
  return f;
}

}  // namespace pastefit
