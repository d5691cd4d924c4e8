#include "core/step/sleepers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/step/state.h"

namespace pastefit {

namespace {

constexpr double kSlow = 0.001;  // of the fall speed sqrt(g R): a thirtieth of `RestCriterion::speed_over_fall`
constexpr double kFallAsleepLoad = 0.05, kWakeLoad = 0.2;  // of a grain's weight
constexpr std::int64_t kStepsBetweenLooks = 8;
constexpr std::uint8_t kLooks = 12;             // in a row that find a grain calm before it may sleep
constexpr std::int64_t kStepsPerChoice = 16;    // after which pairs are chosen anew for grains that woke
constexpr std::int64_t kStepsPerBedtime = 128;  // after which they are for grains that are calm

double squared(double value) {
  return value * value;
}

/// Whether what acts on a grain leaves over less than this share of its weight, as a force or at its surface.
bool is_balanced(const World& world, std::int32_t i, double share) {
  const Load& load = world.particles.load[i];
  const double weight = world.particles.mass(i) * world.gravity, radius = world.particles.motion[i].radius;
  const Vec3 left = vector_of(load.force) - Vec3{0, 0, weight}, torque = vector_of(load.torque);
  return dot(left, left) < squared(share * weight) && dot(torque, torque) < squared(share * weight * radius);
}

void add(Load& load, const Load& other) {
  for (int c = 0; c < 3; ++c) {
    load.force[c] += other.force[c];
    load.torque[c] += other.torque[c];
  }
  load.damping += other.damping;
  load.stiffness += other.stiffness;
}

}  // namespace

void Sleepers::take_place(const World& world) {
  const std::size_t blocks = world.pairs.blocks.size();
  calm_.resize(world.particles.count(), 0);
  for (std::vector<Load>& held : held_) held.assign(world.particles.load.size(), {});
  if (energy_.size() < blocks) energy_.resize(blocks);
  for (EnergySums& energy : energy_) energy.forget(EnergySums::stored);
  chosen_.assign(blocks, false);
  woken_.assign(blocks, false);
  asleep_.assign(blocks, 0);
  if (dissipation_.size() < blocks) dissipation_.resize(blocks);
}

void Sleepers::check_state(const World& world, bool listed) const {
  const std::size_t blocks = world.pairs.blocks.size(), grains = world.particles.identity.size();
  const auto counts = [](std::uint8_t calm) { return calm <= kLooks || calm == kAsleep; };
  demand(calm_.size() <= grains && std::ranges::all_of(calm_, counts), "a grain is calm for longer than it can be");
  if (!listed) return;  // the rest is made anew
  demand(calm_.size() == grains && held_[0].size() == world.particles.load.size() &&
             held_[1].size() == held_[0].size() && energy_.size() >= blocks && chosen_.size() == blocks &&
             woken_.size() == blocks && asleep_.size() == blocks && dissipation_.size() >= blocks,
         "the sleepers are of another number of grains");
  for (const std::vector<Load>& held : held_)
    for (const Load& load : held)
      demand(std::isfinite(load.force[0] + load.force[1] + load.force[2]) &&
                 std::isfinite(load.torque[0] + load.torque[1] + load.torque[2]) &&
                 std::isfinite(load.damping + load.stiffness),
             "what a sleeper holds is not finite");
  for (const EnergySums& energy : energy_) demand(energy.is_finite(), "an energy is not finite");
  for (std::size_t b = 0; b < blocks; ++b)
    demand(asleep_[b] >= 0 && static_cast<std::size_t>(asleep_[b]) <= grains, "more grains sleep than there are");
}

void Sleepers::fall_asleep(World& world, std::size_t block) {
  woken_[block] = false;
  Particles& particles = world.particles;
  for (std::int32_t i = world.pairs.blocks[block].grains; i < world.pairs.blocks[block].grains_end; ++i) {
    std::uint8_t& calm = calm_[particles.identity[i]];
    if (calm < kLooks || calm == kAsleep) continue;
    calm = kAsleep;
    const Velocity& velocity = particles.velocity[i];
    dissipation_[block] += 0.5 / velocity.inverse_mass * dot(velocity.linear, velocity.linear) +
                           0.5 / velocity.inverse_inertia * dot(velocity.angular, velocity.angular);
    set_velocity(particles, i, {}, {});
  }
}

void Sleepers::hold(const World& world, std::size_t b, KernelTask task, Kernel pair_kernel, Kernel bridge_kernel) {
  const std::vector<Block>& blocks = world.pairs.blocks;
  const bool woken = woken_[b] || (b + 1 < blocks.size() && woken_[b + 1]);
  if (!chosen_[b] && !woken) return;
  chosen_[b] = false;
  std::vector<Load>& held = held_[b % 2];
  const std::int32_t end = blocks[std::min(b + 1, blocks.size() - 1)].grains_end;
  std::fill(held.begin() + blocks[b].grains, held.begin() + end, Load{});
  energy_[b].forget(EnergySums::stored);
  task.load = held.data();
  task.energy = &energy_[b];
  task.energies = Energies::all;
  const ContactList& contacts = blocks[b].contacts;
  task.stretch = {contacts.awake / kBatch, contacts.batch_count(), contacts.batch_count()};
  pair_kernel(task);
  const BridgeList& bridges = blocks[b].bridges;
  if (bridges.count == bridges.awake) return;
  task.stretch = {bridges.awake / kBatch, 0, bridges.batch_count()};
  bridge_kernel(task);
}

bool Sleepers::balance(World& world, std::size_t block) {
  Particles& particles = world.particles;
  const bool look = world.step % kStepsBetweenLooks == 0;
  bool drowsy = false;
  asleep_[block] = 0;
  for (std::int32_t i = world.pairs.blocks[block].grains; i < world.pairs.blocks[block].grains_end; ++i) {
    std::uint8_t& calm = calm_[particles.identity[i]];
    Load& load = particles.load[i];
    if (calm == kAsleep || woken_[block]) {
      add(load, held_[0][i]);
      add(load, held_[1][i]);
    }
    if (calm == kAsleep) {
      if (!is_balanced(world, i, kWakeLoad)) {
        calm = 0;
        woken_[block] = true;
        continue;
      }
      // Held up by just its weight it stays where it is, but for the last bit of the speed it is given in a step.
      load = {.force = {0, 0, static_cast<float>(particles.mass(i) * world.gravity)},
              .damping = load.damping,
              .stiffness = load.stiffness};
      set_velocity(particles, i, {}, {});
      ++asleep_[block];
    } else if (look) {
      calm = is_calm(world, i) ? std::min<std::uint8_t>(calm + 1, kLooks) : 0;
      drowsy |= calm == kLooks;
    }
  }
  return (woken_[block] && world.step % kStepsPerChoice == 0) || (drowsy && world.step % kStepsPerBedtime == 0);
}

bool Sleepers::is_calm(const World& world, std::int32_t i) const {
  const Velocity& velocity = world.particles.velocity[i];
  const double slow = squared(kSlow) * world.gravity * world.reference_radius;
  return dot(velocity.linear, velocity.linear) < slow &&
         squared(world.particles.motion[i].radius) * dot(velocity.angular, velocity.angular) < slow &&
         is_balanced(world, i, kFallAsleepLoad);
}

std::int64_t Sleepers::count() const {
  return std::accumulate(asleep_.begin(), asleep_.end(), std::int64_t{0});
}

void Sleepers::enter(EnergyBalance& energy_balance) const {
  energy_balance.stored += total(energy_, EnergySums::stored);
  energy_balance.dissipation_normal += total(energy_, EnergySums::normal_damping);
  energy_balance.dissipation_sliding += total(energy_, EnergySums::sliding);
  energy_balance.dissipation_rolling += total(energy_, EnergySums::rolling);
  energy_balance.dissipation_bridges += total(energy_, EnergySums::bridges);
  energy_balance.dissipation_sleep = std::accumulate(dissipation_.begin(), dissipation_.end(), 0.0);
}

}  // namespace pastefit
