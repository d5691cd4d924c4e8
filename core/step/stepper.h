#pragma once

#include <functional>
#include <optional>

#include "core/result.h"
#include "core/step/energy_balance.h"
#include "core/step/kernels.h"
#include "core/step/lists.h"
#include "core/step/time_step.h"
#include "core/world/world.h"

namespace pastefit {

/// Advances a world in time: lists, step size, forces, motion, failures.
///
///     lists     sort -> neighbour list -> contacts, bridges     only where no longer valid (lists.h)
///     step      dt from stiffness, impacts, bridges, liquid     (time_step.h)
///     forces    pairs, bridges, walls of a block      \        a block moves as soon as its forces
///     motion    v(n-1/2) -> v(n+1/2), x(n) -> x(n+1)  /        are complete
///     walls     drive sets velocities, energy balance, walls move
///
///         x(n-1)           x(n)           x(n+1)
///     -----o----------------o----------------o-----> time
///                v(n-1/2)         v(n+1/2)
///
/// Leapfrog: velocities are half a step before positions; the first step is a half kick.
class Stepper {
 public:
  Stepper(World& world, const StepOptions& options);

  /// One time step. `drive` sets the walls' velocities; it may use the loads on them and the step, but not the grains,
  /// which may have moved already. Returns the reason if the run cannot continue.
  std::optional<Failure> step(const std::function<void(World&, double)>& drive);

  /// Call after a change of the world from outside (walls or laws added or removed, grains moved).
  void forget_lists() { lists_.forget(); }

  /// Removes the last wall with the energy of its contacts and bridges, which counts as work of the wall.
  void take_away_last_wall();

  /// Call after grains and walls were lifted from outside, with the work done on the grains [J].
  void lifted(double work_j);

  /// True if the next step will fail because of this one.
  bool has_failed() const { return runaway_ >= 0; }
  double time_step() const { return dt_; }
  /// Smallest computed step so far [s]; a fixed step should not be larger.
  double smallest_advised_step() const { return time_step_.smallest(); }
  /// Energy balance at the last step whose number was a multiple of `kBalanceInterval`.
  const EnergyBalance& energy_balance() const { return energy_balance_; }
  /// Continues the energy balance of a preceding run.
  void follow(const EnergyBalance& before);
  static constexpr std::int64_t kBalanceInterval = 32;
  /// For `RunCheckpoint`: all except the world. The rest is scratch, or follows from the test.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(lists_, dt_, fastest_, stiffest_, pierced_, runaway_, time_step_, energy_, energy_balance_, looked_);
  }
  /// Throws `BadState` if the state read does not belong to the world.
  void check_state() const;

 private:
  /// Loads of a block on a wall.
  struct WallShare {
    Vec3 force, torque;
    std::int32_t pierced = -1;  ///< a grain too deep in the wall
  };

  std::optional<Failure> maintain_lists();
  double next_step();
  /// Computes all forces; if `dt` is given, moves the grains of a block as soon as their forces are complete.
  void compute_forces(std::optional<double> dt);
  void act_on_pairs(int block);
  void act_on_walls(int block, int member);
  void act_on_wall(std::size_t wall, int block, Column<WallBatch>& batches);
  /// Runs `task` for these contacts with a wall; `batches` contain their geometry.
  void act_on(const Wall& wall, WallContacts& touching, Column<WallBatch>& batches, KernelTask task) const;
  KernelTask task(const PairConstants& pair, int block);
  void add_up_walls();
  std::int32_t find_wall(const Wall& wall, const WallContacts& touching, Column<WallBatch>& batches) const;
  void add_loads(const Wall& wall, const WallContacts& touching, const Column<WallBatch>& batches, WallShare& sum);
  void account_walls(double dt);
  double held_by(std::size_t wall);
  void move_block(int block, double dt);
  void note_moved();
  bool looks_at_energy() const { return options_.energy_balance && world_.step % kBalanceInterval == 0; }
  void look_at_energy(double dt);
  std::string remedy_of_sizes() const;
  Failure failure(FailureReason reason, std::int64_t grain, double value, double limit, std::string message) const;

  World& world_;
  StepOptions options_;
  const KernelTable& kernels_;
  ThreadPool pool_;
  Lists lists_;

  double dt_ = 0;              ///< step that led to the present positions; 0 before the first
  double fastest_ = 0;         ///< largest speed of a grain at the last step
  double stiffest_ = 0;        ///< largest stiffness over mass of a grain at the last step [1/s^2]
  std::int32_t pierced_ = -1;  ///< a grain too deep in a wall
  std::int32_t runaway_ = -1;  ///< a grain with an impossible speed, or one that is not a number
  double smallest_radius_ = 0, smallest_mass_ = 0;
  TimeStep time_step_;
  std::vector<EnergySums> energy_;               ///< of each block
  std::vector<Column<WallBatch>> wall_batches_;  ///< by member of the pool: contacts of a block with a wall
  std::vector<WallShare> wall_shares_;           ///< of each block, for each wall
  std::vector<Moved> moved_;
  EnergyBalance energy_balance_;
  bool looked_ = false;  ///< the start of the energy balance is set
};

}  // namespace pastefit
