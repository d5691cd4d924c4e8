#include "core/step/stepper.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/step/state.h"
#include "core/step/state_check.h"

namespace pastefit {

namespace {

constexpr double kSmallestShare = 1e-4;  // of the first step; normal runs stay within a factor of ten
constexpr int kGrainsInCache = 4000;     // with contacts about 300 bytes each: one megabyte

double speed_of(const Wall& wall) {
  // The farthest point of a rotating wall is not known here; rotating walls are plates of at most a few metres.
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

}  // namespace

Stepper::Stepper(World& world, const StepOptions& options)
    : world_(world),
      options_(options),
      kernels_(options.kernels ? *options.kernels : kernels_of_this_processor()),
      pool_(options.threads),
      lists_(world, options.skin * world.reference_radius, pool_, kernels_, options.clock),
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
  // All forces before any motion: in the first step, which follows from them, and for the energy balance. Otherwise a
  // block is moved while it is in the cache, which is a tenth faster in a bed too large for it.
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
  demand(dt_ >= 0 && fastest_ >= 0 && fastest_ <= kRunawaySpeed && stiffest_ >= 0 && time_step_.is_sound(),
         "a time step, a speed or a stiffness is below nothing, or beyond any");
  demand(pierced_ == -1 && runaway_ == -1, "the run has failed");
  for (const EnergySums& energy : energy_) demand(are_possible(energy), "an energy is larger than any can be");
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
                   "two grains overlap by more than the allowed share of the smaller radius; stiffer grains or less "
                   "cohesion" +
                       remedy_of_sizes());
  return {};
}

/// The pressure of large grains on small ones grows with the size ratio.
std::string Stepper::remedy_of_sizes() const {
  constexpr double uneven = 2;
  double largest = 0;
  for (std::int32_t i = 0; i < world_.particles.count(); ++i)
    largest = std::max(largest, world_.particles.motion[i].radius);
  const double ratio = largest / smallest_radius_;
  if (ratio <= uneven) return "";
  return ", or sizes nearer to each other: the largest grain is " + std::to_string(std::lround(ratio)) +
         " times the smallest";
}

/// Except in the first step, uses stiffness and speeds of the step before, which moving the grains gave; safety covers
/// the difference.
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
  task.fetches_ahead = world_.particles.count() > kGrainsInCache;
  return task;
}

void Stepper::act_on_pairs(int b) {
  const Kernels& of_pairs = world_.grain_pair.viscosity > 0 ? kernels_.viscous_pair : kernels_.pair;
  const Kernel pairs =
      of_pairs[combination(acting(world_.normal, world_.grain_pair), world_.attraction, world_.rolling)];
  const Kernel bridges = kernels_.bridge[row_of(world_.attraction)];
  Block& block = world_.pairs.blocks[b];
  KernelTask mine = task(world_.grain_pair, b);
  mine.contacts = block.contacts.batches.data();
  mine.stretch = {0, block.contacts.near / kBatch, block.contacts.batch_count()};
  {
    const Timed timed(options_.clock, StageClock::pair);
    pairs(mine);
  }
  mine.bridges = block.bridges.batches.data();
  mine.stretch = {0, 0, block.bridges.batch_count()};
  if (block.bridges.count > 0) {
    const Timed timed(options_.clock, StageClock::bridge);
    bridges(mine);
  }
}

void Stepper::move_block(int b, double dt) {
  const Timed timed(options_.clock, StageClock::move);
  Particles& particles = world_.particles;
  const Block& block = world_.pairs.blocks[b];
  moved_[b] = kernels_.move({particles.motion.data(), particles.velocity.data(), particles.load.data(), lists_.bounds(),
                             block.grains, block.grains_end, dt, 0.5 * (dt_ + dt), world_.gravity, world_.drag});
  if (moved_[b].exceeded) lists_.note_exceeded(b);
}

/// Combines the results of all moved blocks, and clears the loads of the dummies.
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
