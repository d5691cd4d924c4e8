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

/// Carries a world through time: lists, forces, integration, step size, failures.
///
/// Leapfrog: velocities live half a step before positions; the first step is a half kick. Work that is not needed in
/// every step is done when a bound on what can have moved is used up: contacts are selected from the candidates, and
/// the candidates listed anew.
class Stepper {
 public:
  Stepper(World& world, const StepOptions& options);

  /// One time step. `drive` sets the walls' velocities for it, knowing the loads on them and the step; of the grains it
  /// knows nothing: they may have been moved by then.
  /// Returns nothing, or why the run cannot go on.
  std::optional<Failure> step(const std::function<void(World&, double)>& drive);

  /// To be called after the world was changed from outside (walls or laws added or removed, grains moved).
  void forget_lists() { lists_.forget(); }

  /// Takes the last wall away, and with it what its contacts and bridges hold: the work of whoever removes it.
  void take_away_last_wall();

  /// To be called after grains and walls were lifted from outside, with the work that was done on the grains [J].
  void lifted(double work_j);

  /// Whether the next step will fail for what this one did.
  bool has_failed() const { return runaway_ >= 0; }
  double time_step() const { return dt_; }
  /// The smallest step the scene has asked for so far [s]: what a fixed step should have been.
  double smallest_advised_step() const { return time_step_.smallest(); }
  /// As of the last step that was a multiple of `kBalanceInterval`.
  const EnergyBalance& energy_balance() const { return energy_balance_; }
  /// The run goes on from where another one ended, whose energy balance this is.
  void follow(const EnergyBalance& before);
  static constexpr std::int64_t kBalanceInterval = 32;
  /// For `RunCheckpoint`: all but the world. The rest is scratch, or follows from the test.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(lists_, dt_, fastest_, stiffest_, pierced_, runaway_, time_step_, energy_, energy_balance_, looked_);
  }
  /// Throws `BadState` unless what was read is of the world as it is.
  void check_state() const;

 private:
  /// What a block does to a wall.
  struct WallShare {
    Vec3 force, torque;
    std::int32_t pierced = -1;  ///< a grain too deep in the wall
  };

  std::optional<Failure> maintain_lists();
  double next_step();
  /// All forces; where `dt` is given, the grains of a block are moved by it as soon as their forces are complete.
  void compute_forces(std::optional<double> dt);
  void act_on_pairs(int block);
  void act_on_walls(int block, int member);
  void act_on_wall(std::size_t wall, int block, Column<WallBatch>& batches);
  /// `task` done for these contacts with a wall, of which `batches` say how they lie to it.
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
  std::int32_t runaway_ = -1;  ///< a grain beyond any speed, or with none that is a number
  double smallest_radius_ = 0, smallest_mass_ = 0;
  TimeStep time_step_;
  std::vector<EnergySums> energy_;               ///< of each block
  std::vector<Column<WallBatch>> wall_batches_;  ///< of each member of the pool: of a block's contacts with a wall
  std::vector<WallShare> wall_shares_;           ///< of each block, for each wall
  std::vector<Moved> moved_;
  EnergyBalance energy_balance_;
  bool looked_ = false;  ///< the energy balance has its start
};

}  // namespace pastefit
