#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/simulate.h"
#include "core/step/stepper.h"

namespace pastefit {

/// When a heap counts as at rest: the grains' root mean square speed is below a bound, and neither the top, nor the
/// mean height, nor the mean distance from the axis has changed by more than a share of a radius over the last window.
/// A stiff heap swings for long like a jelly; that moves no reading by more than these bounds.
struct RestCriterion {
  double window_s = 0.05;
  double speed_over_fall = 0.03;     ///< bound on the speed over sqrt(g R)
  double change_over_radius = 0.02;  ///< bound on the changes over the mean radius
};

/// Runs a world through the phases of a test, watched by the caller, until each phase's own end.
class Runner {
 public:
  Runner(World& world, const RunOptions& options, const StepOptions& steps);

  using Drive = std::function<void(World&, double dt)>;

  /// Steps for `duration_s`, or until `done` (asked after every step) says so.
  std::optional<Failure> run(std::string_view phase, double duration_s, const Drive& drive = {},
                             const std::function<bool(const World&)>& done = {});

  /// Runs `run` in windows until the heap is at rest and `free` holds, or `done` does, for `longest_s` at most.
  std::optional<Failure> run_until_rest(std::string_view phase, double longest_s,
                                        const std::function<bool(const World&)>& free,
                                        const std::function<bool(const World&)>& done,
                                        const RestCriterion& criterion = {});

  /// Steps until the heap is at rest, for `cap_s` at most; at the cap the run goes on, marked as not settled, unless
  /// the heap still moves fast enough that its readings mean nothing.
  std::optional<Failure> settle(std::string_view phase, double cap_s, const RestCriterion& criterion = {});

  /// As `settle`, but it does not matter whether rest is reached within the time.
  std::optional<Failure> relax(std::string_view phase, double cap_s, const RestCriterion& criterion = {});

  /// To be called after walls, laws or grains were changed from outside.
  void changed() { stepper_.forget_lists(); }

  const RunSummary& summary();
  const Ledger& ledger() const { return stepper_.ledger(); }

 private:
  struct Wait {
    std::optional<Failure> failure;
    bool rested = false;
    double change = 0;  ///< in the last window [m]
  };
  Wait wait_for_rest(std::string_view phase, double cap_s, const RestCriterion& criterion,
                     const std::function<bool(const World&)>& free = {},
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
};

}  // namespace pastefit
