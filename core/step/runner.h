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

/// A part of a test, in the laboratory's words.
struct Phase {
  std::string_view name;
  std::function<void(World&, double dt)> drive{};  ///< moves walls before every step; empty: none is moved
  std::function<bool(const World&)> done{};        ///< asked after every step; true ends the phase
  /// Simulated time that waits of the same name may take after this one [s]: for those who look how much is left.
  PhaseLeft after{};
};

/// Lengths of a specimen that stay where they are once it is at rest [m]: the apparatus's word.
using RestMeasure = std::function<std::vector<double>(const Particles&)>;

/// Runs a world through the phases of a test, watched by the caller, until each phase's own end.
///
/// The specimen is at rest when its grains are slow and no length of its rest measure changes any more
/// (`RestCriterion`).
class Runner {
 public:
  Runner(World& world, const RunOptions& options, RestMeasure rest_measure);

  /// Steps for `duration_s`, or until the phase is done.
  std::optional<Failure> run(const Phase& phase, double duration_s);

  /// Steps until the specimen is at rest and `free` holds, or the phase is done, for `longest_s` at most.
  std::optional<Failure> run_until_rest(const Phase& phase, double longest_s,
                                        const std::function<bool(const World&)>& free);

  /// Steps until the specimen is at rest or the phase is done, for `moved_s`, in which the test itself moves it, and
  /// `cap_s` more at most. At the cap the run goes on, marked as not settled, unless the specimen still moves fast
  /// enough that its readings mean nothing. With `RunOptions::fixed_wait_s` for `moved_s` and that, whether it rests or
  /// not.
  std::optional<Failure> settle(const Phase& phase, double cap_s, double moved_s = 0);

  /// Whether the last wait was for rest, and ended because it had come.
  bool rests() const { return progress_.rested; }

  /// Calls the watch now, whatever its interval: a phase has ended that a picture should show.
  std::optional<Failure> show(std::string_view phase);

  /// What the caller changes while a wait of this runner is under way: part of the state of a run that may be
  /// interrupted (`RunCheckpoint`). To be called before the first wait, once; the parts have to outlive it. `sound`:
  /// whether they can be those of this test, when they were read.
  template <class... Parts>
  void remember(std::function<bool()> sound, Parts&... parts) {
    write_own_ = [&parts...](StateWriter& state) { state(parts...); };
    read_own_ = [&parts..., sound = std::move(sound)](StateReader& state) {
      state(parts...);
      demand(sound(), "what the test has summed up is not of this test");
    };
  }

  /// Takes the last wall away, with what sticks to it let go.
  void take_away_last_wall() { stepper_.take_away_last_wall(); }

  /// To be called after walls, laws or grains were changed from outside.
  void changed() { stepper_.forget_lists(); }

  /// The same after grains and walls were lifted, so slowly that nothing else changed, by this work on the grains [J].
  void lifted(double work_j) { stepper_.lifted(work_j); }

  const RunSummary& summary();
  const EnergyBalance& energy_balance() const { return stepper_.energy_balance(); }
  /// The run goes on from where another one ended, whose energy balance this is.
  void follow(const EnergyBalance& before) { stepper_.follow(before); }

 private:
  struct Wait {
    std::optional<Failure> failure;
    bool rested = false;
    bool done = false;  ///< by the phase's own word
    double change = 0;  ///< in the last window [m]
  };
  /// How far the wait under way has come.
  struct Progress {
    double end = 0;                ///< of the run, or the window of a wait for rest [s]
    double waited = 0;             ///< before this window [s]
    int calm = 0;                  ///< windows in a row
    std::vector<double> before{};  ///< rest measure at the beginning of the window
    double cap = 0;                ///< of a wait for rest [s]; 0: the wait is not for rest
    bool rested = false;           ///< a wait for rest has ended with it
    template <class Archive>
    void serialize(Archive& archive) {
      archive(end, waited, calm, before, cap);
    }
  };
  /// One wait: `wait(midway)`, where `midway` says that it was interrupted and goes on; nothing, if it had ended before
  /// that (`RunCheckpoint`).
  template <class Body>
  std::optional<Failure> resumable(const Body& wait);
  RunCheckpoint::Wait state();
  void recall(const RunCheckpoint::Wait& left);
  void check_progress(double longest_s, double cap_s) const;
  /// What an apparatus sees of the world, and changes of it.
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
  /// Energy created over energy put in, as of the last look of the energy balance.
  double energy_error() const;
  std::optional<Failure> audit(std::string_view phase);

  World& world_;
  const RunOptions& options_;
  RestMeasure rest_measure_;
  Stepper stepper_;
  RunSummary summary_;
  double next_watch_ = 0;
  Progress progress_;
  std::optional<std::size_t> last_ended_;  ///< wait in the checkpoint
  bool is_whole_ = true;                   ///< all of what was recalled last is there, and the run can go on from it
  std::function<void(StateWriter&)> write_own_;
  std::function<void(StateReader&)> read_own_;
};

}  // namespace pastefit
