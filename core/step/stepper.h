#pragma once

#include <functional>
#include <optional>

#include "core/result.h"
#include "core/step/kernels.h"
#include "core/step/ledger.h"
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

  /// One time step. `drive` sets the walls' velocities for it, knowing the loads on them and the step.
  /// Returns the step [s], or why the run cannot go on.
  std::optional<Failure> step(const std::function<void(World&, double)>& drive);

  /// To be called after the world was changed from outside (walls or laws added or removed, grains moved).
  void forget_lists() { lists_valid_ = false; }

  double time_step() const { return dt_; }
  /// The smallest step the scene has asked for so far [s]: what a fixed step should have been.
  double smallest_advised_step() const { return time_step_.smallest(); }
  /// As of the last step that was a multiple of `kLedgerInterval`.
  const Ledger& ledger() const { return ledger_; }
  static constexpr std::int64_t kLedgerInterval = 32;

 private:
  std::optional<Failure> maintain_lists();
  void compute_forces();
  void act_on_wall(Wall& wall);
  void account_walls(double dt);
  void integrate(double dt);
  void look_at_energy(double dt);
  Failure failure(FailureReason reason, std::int64_t grain, double value, double limit, std::string message) const;

  World& world_;
  StepOptions options_;
  const KernelTable& kernels_;
  Scratch scratch_;
  Leeway leeway_;
  std::vector<Vec3> listed_position_;

  bool lists_valid_ = false;
  bool strayed_ = false;    ///< a grain has left its leeway
  double wall_leeway_ = 0;  ///< way of a wall that the selected contacts allow for [m]
  double wall_moved_ = 0;   ///< bound on what has been used of it [m]

  double dt_ = 0;              ///< step that led to the present positions; 0 before the first
  double fastest_ = 0;         ///< largest speed of a grain at the last step
  std::int32_t pierced_ = -1;  ///< a grain too deep in a wall
  std::int32_t runaway_ = -1;  ///< a grain beyond any speed, or with none that is a number
  double smallest_radius_ = 0, smallest_mass_ = 0;
  TimeStep time_step_;
  EnergySums energy_;
  Ledger ledger_;
  bool looked_ = false;  ///< the ledger has its start
};

}  // namespace pastefit
