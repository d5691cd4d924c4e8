#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/step/run.h"
#include "core/step/stepper.h"

namespace pastefit {

/// Runs a world through the phases of a test, watched by the caller, until each phase's own end.
class Runner {
 public:
  Runner(World& world, const RunOptions& options);

  using Drive = std::function<void(World&, double dt)>;

  /// Steps for `duration_s`, or until `done` (asked after every step) says so.
  std::optional<Failure> run(std::string_view phase, double duration_s, const Drive& drive = {},
                             const std::function<bool(const World&)>& done = {});

  /// Runs `run` in windows until the heap is at rest and `free` holds, or `done` does, for `longest_s` at most.
  std::optional<Failure> run_until_rest(std::string_view phase, double longest_s,
                                        const std::function<bool(const World&)>& free,
                                        const std::function<bool(const World&)>& done);

  /// Steps until the heap is at rest or `done` says so, for `cap_s` at most; at the cap the run goes on, marked as not
  /// settled, unless the heap still moves fast enough that its readings mean nothing.
  std::optional<Failure> settle(std::string_view phase, double cap_s,
                                const std::function<bool(const World&)>& done = {});

  /// As `settle`, but it does not matter whether rest is reached within the time.
  std::optional<Failure> relax(std::string_view phase, double cap_s);

  /// Calls the watch now, whatever its interval: a phase has ended that a picture should show.
  std::optional<Failure> show(std::string_view phase);

  /// To be called after walls, laws or grains were changed from outside.
  void changed() { stepper_.forget_lists(); }

  const RunSummary& summary();
  const Ledger& ledger() const { return stepper_.ledger(); }
  /// The run goes on from where another one ended, whose ledger this is.
  void follow(const Ledger& before) { stepper_.follow(before); }

 private:
  struct Wait {
    std::optional<Failure> failure;
    bool rested = false;
    double change = 0;  ///< in the last window [m]
  };
  Wait wait_for_rest(std::string_view phase, double cap_s, const std::function<bool(const World&)>& free = {},
                     const std::function<bool(const World&)>& done = {});
  std::optional<Failure> tell(std::string_view phase);
  /// Energy created over energy put in, as of the ledger's last look.
  double energy_error() const;
  std::optional<Failure> audit(std::string_view phase);

  World& world_;
  const RunOptions& options_;
  Stepper stepper_;
  RunSummary summary_;
  double next_watch_ = 0;
  std::int64_t asleep_steps_ = 0;  ///< of a grain
};

}  // namespace pastefit
