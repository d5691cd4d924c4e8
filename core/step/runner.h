#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "core/step/run.h"
#include "core/step/run_checkpoint.h"
#include "core/step/state.h"
#include "core/step/stepper.h"

namespace pastefit {

/// A phase of a test.
struct Phase {
  std::string_view name;
  std::function<void(World&, double dt)> drive{};  ///< sets wall velocities in every step; empty: walls are at rest
  std::function<bool(const World&)> done{};        ///< checked after every step; true ends the phase
  /// Simulated time of later waits of the same name [s], for progress reports.
  PhaseLeft after{};
};

/// Lengths of a specimen that are constant at rest [m]; defined by the apparatus.
using RestMeasure = std::function<std::vector<double>(const Particles&)>;

/// Runs a world through the phases of a test, observed by the caller.
///
/// The specimen is at rest when its grains are slow and no length of its rest measure changes any more
/// (`RestCriterion`).
class Runner {
 public:
  Runner(World& world, const RunOptions& options, RestMeasure rest_measure);

  /// Steps for `duration_s`, or until the phase is done.
  std::optional<Failure> run(const Phase& phase, double duration_s);

  /// Steps until the specimen is at rest and `free` is true, or the phase is done, for `longest_s` at most.
  std::optional<Failure> run_until_rest(const Phase& phase, double longest_s,
                                        const std::function<bool(const World&)>& free);

  /// Steps until the specimen is at rest or the phase is done, for at most `moved_s` + `cap_s`; the test moves it for
  /// `moved_s`. At the limit the run continues, marked as not settled, unless the specimen is too fast for valid
  /// readings. With `RunOptions::fixed_wait_s`, the wait lasts `moved_s` plus this time, at rest or not.
  std::optional<Failure> settle(const Phase& phase, double cap_s, double moved_s = 0);

  /// True if the last wait was for rest and ended at rest.
  bool rests() const { return progress_.rested; }

  /// Calls the watch now, independent of its interval: shows the end of a phase.
  std::optional<Failure> show(std::string_view phase);

  /// Adds variables that the caller changes during a wait to the state of a run (`RunCheckpoint`). Call once, before
  /// the first wait; the variables must outlive the runner. `sound`: true if values read are possible for this test.
  template <class... Parts>
  void remember(std::function<bool()> sound, Parts&... parts) {
    write_own_ = [&parts...](StateWriter& state) { state(parts...); };
    read_own_ = [&parts..., sound = std::move(sound)](StateReader& state) {
      state(parts...);
      demand(sound(), "what the test has summed up is not of this test");
    };
  }

  /// Removes the last wall; grains that adhere to it are released.
  void take_away_last_wall() { stepper_.take_away_last_wall(); }

  /// Call after a change of walls, laws or grains from outside.
  void changed() { stepper_.forget_lists(); }

  /// Call after grains and walls were lifted quasi-statically, with the work done on the grains [J].
  void lifted(double work_j) { stepper_.lifted(work_j); }

  const RunSummary& summary();
  const EnergyBalance& energy_balance() const { return stepper_.energy_balance(); }
  /// Continues the energy balance of a preceding run.
  void follow(const EnergyBalance& before) { stepper_.follow(before); }

 private:
  struct Wait {
    std::optional<Failure> failure;
    bool rested = false;
    bool done = false;  ///< ended by the phase
    double change = 0;  ///< in the last window [m]
  };
  /// Progress of the current wait.
  struct Progress {
    double end = 0;                ///< of the run, or of the window of a wait for rest [s]
    double waited = 0;             ///< before this window [s]
    int calm = 0;                  ///< consecutive windows
    std::vector<double> before{};  ///< rest measure at the beginning of the window
    double cap = 0;                ///< time limit of a wait for rest [s]; 0: not a wait for rest
    bool rested = false;           ///< a wait for rest has ended at rest
    template <class Archive>
    void serialize(Archive& archive) {
      archive(end, waited, calm, before, cap);
    }
  };
  /// One wait: `wait(midway)`, with `midway` true if it resumes an interrupted one; no call if it had been completed
  /// (`RunCheckpoint`).
  template <class Body>
  std::optional<Failure> resumable(const Body& wait);
  RunCheckpoint::Wait state();
  void recall(const RunCheckpoint::Wait& left);
  void check_progress(double longest_s, double cap_s) const;
  /// What an apparatus reads and changes of the world.
  template <class Archive>
  void seen(Archive& archive) {
    archive(world_.time, world_.step, world_.particles.motion, world_.particles.velocity, world_.particles.load,
            world_.particles.identity, progress_.rested);
    for (Wall& wall : world_.walls)
      archive(wall.shape, wall.velocity, wall.angular_velocity, wall.pivot, wall.velocity_before,
              wall.angular_velocity_before, wall.force, wall.torque);
  }
  template <class Archive>
  void hidden(Archive& archive) {
    archive(world_.pairs, stepper_, summary_.steps, summary_.particle_steps, summary_.settled, summary_.ended_early,
            progress_, next_watch_);
  }

  /// Steps until `progress_.end`, or the phase is done.
  std::optional<Failure> advance(const Phase& phase);
  Wait wait_for_rest(const Phase& phase, double cap_s, bool midway, const std::function<bool(const World&)>& free = {});
  std::optional<Failure> settle_now(const Phase& phase, double cap_s, bool midway);
  std::optional<Failure> tell(const Phase& phase);
  std::optional<Failure> look(const Snapshot& snapshot);
  PhaseLeft left(const Phase& phase) const;
  Failure stopped_in(std::string_view phase) const;
  /// Energy created over energy put in, at the last evaluation of the energy balance.
  double energy_error() const;
  std::optional<Failure> audit(std::string_view phase);

  World& world_;
  const RunOptions& options_;
  RestMeasure rest_measure_;
  Stepper stepper_;
  RunSummary summary_;
  double next_watch_ = 0;
  Progress progress_;
  std::optional<std::size_t> last_ended_;  ///< index of the wait in the checkpoint
  bool is_whole_ = true;                   ///< the state last restored is complete, and the run can continue from it
  std::function<void(StateWriter&)> write_own_;
  std::function<void(StateReader&)> read_own_;
};

}  // namespace pastefit
