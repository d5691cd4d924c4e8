#pragma once

#include "core/step/kernels.h"
#include "core/step/stage_clock.h"
#include "core/thread_pool.h"
#include "core/world/selection.h"
#include "core/world/world.h"

namespace pastefit {

/// Keeps the lists of a world true while its grains and walls move. Three kinds, each made from the one before when a
/// bound on what may have moved is used up: all grains, sorted in space; candidates, made anew for the whole world when
/// a grain has used up its share of the skin; contacts and bridges, chosen anew for the blocks of which a grain has
/// left its displacement bound, and for their neighbours that share pairs with them.
class Lists {
 public:
  /// `skin`: of the candidates [m].
  Lists(World& world, double skin, ThreadPool& pool, const KernelTable& kernels, StageClock* clock = nullptr);

  /// To be called after the world was changed from outside.
  void forget() { valid_ = false; }

  /// Brings the lists up to date before a step of about `dt`; the walls have moved by up to `wall_way` since the last
  /// call, and the fastest of them moves with `wall_speed`. Returns the deepest overlap among the pairs it looked at.
  Deepest update(double dt, double wall_way, double wall_speed);

  /// Where the lists allow the grains to be, one room each.
  const DisplacementBound* bounds() const { return bounds_.bounds.data(); }
  /// For `RunCheckpoint`. All else is scratch.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(bounds_.bounds, bounds_.own, rounding_, listed_, exceeded_, valid_, wall_bound_, wall_way_);
  }

  /// Throws `BadState` unless what was read is of the world as it is.
  void check_state() const;

  /// Whether the lists are those of the world as it is, and not to be made anew before the next step.
  bool hold() const { return valid_; }

  /// A grain of the block is not in its room any more.
  void note_exceeded(std::size_t block) { exceeded_[block] = true; }

 private:
  struct Listed {
    float at[3];  ///< [m]
  };

  bool goes_on(double duration);
  void take_along();
  void list_candidates();
  /// Gives the grains of the exceeded blocks a new displacement bound; false if one has too little of its skin left.
  bool give_displacement_bounds(double duration);
  Deepest select_pairs();
  void note_ways();
  void select_at_walls(bool everywhere);

  World& world_;
  double skin_;
  ThreadPool& pool_;
  const KernelTable& kernels_;
  StageClock* clock_;
  std::vector<Selection> selections_;  ///< one for each member of the pool
  DisplacementBounds bounds_;
  std::vector<Listed> listed_;  ///< where the grains were when the candidates were listed
  double rounding_ = 0;         ///< by which those places are off at most [m]
  std::vector<char> exceeded_;  ///< blocks to be chosen for anew (not bool: threads write side by side)
  bool valid_ = false;
  double wall_bound_ = 0;  ///< way of a wall that the selected contacts allow for [m]
  double wall_way_ = 0;    ///< bound on what has been used of it [m]
};

}  // namespace pastefit
