#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "calibrate/base/text.h"
#include "calibrate/laboratory/test.h"
#include "core/laws/constants.h"

namespace pastefit {

/// Simulator used by searches and checks. Tests can replace it by a fast or a faulty one.
struct Engine {
  std::function<std::shared_ptr<const Packing>(const Test&, const RunOptions&)> prepare =
      [](const Test& test, const RunOptions& options) { return pastefit::prepare(test, options); };
  std::function<Outcome(const Test&, const RunOptions&)> run = [](const Test& test, const RunOptions& options) {
    return simulate(test, options);
  };
};

/// Watches simulations during a search, so that they need not be repeated for display. Called from the simulating
/// threads.
class RunObserver {
 public:
  using Watch = std::function<void(const Snapshot&)>;

  virtual ~RunObserver() = default;

  /// Begins a simulation that will run to its end; called in the order of simulations. The result is called from one
  /// thread with the snapshots, starting with those of the filling if it is simulated for this test.
  virtual Watch begin(const Test& test) = 0;

  /// Ends a simulation, also after a failure. Not called for interrupted simulations.
  virtual void end(const Test& test, const Outcome& outcome) = 0;

  /// Simulated time between two snapshots.
  virtual double interval_s() const = 0;
};

/// Failure of a test whose grains are so soft that the overlap by their own attraction exceeds the limit in
/// `RunOptions`; found without simulation. A search calls this before it prepares a candidate: the softer the grains,
/// the smaller the poured volume and the longer the filling of the mould, both without limit.
inline std::optional<Failure> too_soft(const Test& test, const RunOptions& options) {
  const Specimen& specimen = specimen_of(test);
  const double overlap = 2 * resting_overlap(specimen.contact, specimen.grains.radius_m);  // in radii
  if (!(overlap > options.steps.overlap_limit)) return std::nullopt;
  Failure failure;
  failure.reason = FailureReason::excessive_overlap;
  failure.phase = "fill";
  failure.value = overlap;
  failure.limit = options.steps.overlap_limit;
  failure.message = format(
      "the grains' own attraction presses them into each other by %.3g radii; stiffer grains or "
      "less attraction",
      overlap);
  return failure;
}

}  // namespace pastefit
