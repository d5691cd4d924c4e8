#pragma once

#include "core/step/kernels.h"
#include "core/step/stage_clock.h"
#include "core/thread_pool.h"
#include "core/world/selection.h"
#include "core/world/world.h"

namespace pastefit {

/// Keeps the lists of pairs valid while grains and walls move. Each list is made from the one before:
///
///     grains, sorted by cell                whole world, when a grain has used up its share (half)
///       |  gap < reach + skin               of the skin
///     neighbour list (candidates)
///       |  gap < reach + both displacement bounds
///     contacts, bridges, wall contacts      block by block, when a grain of the block has exceeded
///                                           its displacement bound; its neighbour shares pairs
///
///     |<- radii ->|<- reach ->|<-------- skin -------->|    distance of the centres of a candidate
///     |<- radii ->|<- reach ->|<- bounds ->|                of a contact or bridge
class Lists {
 public:
  /// `skin`: of the neighbour list [m].
  Lists(World& world, double skin, ThreadPool& pool, const KernelTable& kernels, StageClock* clock = nullptr);

  /// Call after any change of the world from outside.
  void forget() { valid_ = false; }

  /// Updates the lists before a step of about `dt`. `wall_way`: bound on the displacement of the walls since the last
  /// call; `wall_speed`: speed of the fastest wall. Returns the deepest overlap among the pairs that it checked.
  Deepest update(double dt, double wall_way, double wall_speed);

  /// Displacement bounds of the grains.
  const DisplacementBound* bounds() const { return bounds_.bounds.data(); }
  /// For `RunCheckpoint`. The rest is scratch.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(bounds_.bounds, bounds_.own, rounding_, listed_, exceeded_, valid_, wall_bound_, wall_way_);
  }

  /// Throws `BadState` if the lists read do not belong to the world.
  void check_state() const;

  /// True if the lists are valid, so that the next step need not rebuild them.
  bool hold() const { return valid_; }

  /// A grain of the block has exceeded its displacement bound.
  void note_exceeded(std::size_t block) { exceeded_[block] = true; }

 private:
  struct Listed {
    float at[3];  ///< [m]
  };

  bool goes_on(double duration);
  void take_along();
  void list_candidates();
  /// Sets displacement bounds in the blocks due; false if a grain has too little of its skin left.
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
  std::vector<Listed> listed_;  ///< positions of the grains when the candidates were listed
  double rounding_ = 0;         ///< largest rounding error of those positions [m]
  std::vector<char> exceeded_;  ///< blocks to be selected anew (not bool: threads write side by side)
  bool valid_ = false;
  double wall_bound_ = 0;  ///< displacement of a wall that the selected contacts allow [m]
  double wall_way_ = 0;    ///< bound on the displacement since [m]
};

}  // namespace pastefit
