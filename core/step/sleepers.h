#pragma once

#include <cstdint>
#include <vector>

#include "core/step/energy_balance.h"
#include "core/step/kernels.h"
#include "core/world/world.h"

namespace pastefit {

/// Grains at rest, and what is saved by their resting. A grain falls asleep, when its block's pairs are chosen, if for
/// some hundred steps it has been slower than a thousandth of sqrt(g R), with less than 5 % of its weight left over by
/// its contacts. It then stands still; what its speed held is dissipated. A pair of two sleepers is dormant: it stays
/// in its block's lists with its memory, but what it exerts, which does not change, is computed once, at the choice,
/// and held. The pairs of a sleeper with walls and with grains that are awake act as ever; if with what is held they
/// leave over more than 20 % of its weight, it wakes in the same step with the right force. Until the pairs of its
/// block are chosen anew, the dormant ones are computed in every step. So whatever reaches a sleeper wakes it: a grain
/// that lands or leaves, a wall that moves, another gravity.
///
/// Limits: no weight, no sleep. A grain that only a dashpot holds up (constant-torque rolling on a slope) creeps as
/// long as it is awake: asleep it would start to roll, wakes at once, and creeps on from rest.
class Sleepers {
 public:
  /// To be called after the world was changed from outside.
  void wake_all() { calm_.clear(); }
  /// To be called when the blocks are other ones.
  void take_place(const World& world);

  /// Puts the block's calm grains to sleep.
  void fall_asleep(World& world, std::size_t block);
  /// Its pairs were chosen anew: what they hold is to be computed.
  void note_chosen(std::size_t block) { chosen_[block] = true; }
  /// Computes what the dormant pairs of a block exert, if it is not what is held; `task`: as for its other pairs.
  void hold(const World& world, std::size_t block, KernelTask task, Kernel pair_kernel, Kernel bridge_kernel);

  /// To be called when all loads of a step are there: completes the loads on sleepers and wakes those they do not leave
  /// at rest; now and then looks which others are calm. Whether it is time to choose the block's pairs anew for that.
  bool balance(World& world, std::size_t block);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(calm_, held_[0], held_[1], energy_, chosen_, woken_, asleep_, dissipation_);
  }

  /// Throws `BadState` unless what was read is of this world; `listed`: its blocks are those of the world as it is.
  void check_state(const World& world, bool listed) const;

  bool is_asleep(std::int32_t identity) const { return calm_[identity] == kAsleep; }
  /// Of all blocks in the last step.
  std::int64_t count() const;
  /// What they have dissipated and what dormant pairs store.
  void enter(EnergyBalance& energy_balance) const;

 private:
  static constexpr std::uint8_t kAsleep = 255;

  bool is_calm(const World& world, std::int32_t grain) const;

  std::vector<std::uint8_t> calm_;  ///< by identity: for how many looks a grain has been calm, or that it is asleep
  /// By grain: of the dormant pairs of blocks of even and of odd number, no two of which share a grain.
  std::vector<Load> held_[2];
  std::vector<EnergySums> energy_;  ///< of each block's dormant pairs
  std::vector<char> chosen_;
  std::vector<char> woken_;           ///< blocks that have grains awake among dormant pairs
  std::vector<std::int32_t> asleep_;  ///< of each block
  std::vector<double> dissipation_;   ///< by block
};

}  // namespace pastefit
