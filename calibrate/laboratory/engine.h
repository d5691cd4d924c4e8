#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "calibrate/laboratory/test.h"

namespace pastefit {

/// What is asked of the engine, by a search as by a check. A test may put a quick or a spoiled one in its place.
struct Engine {
  std::function<std::shared_ptr<const Packing>(const Test&, const RunOptions&)> prepare =
      [](const Test& test, const RunOptions& options) { return pastefit::prepare(test, options); };
  std::function<Outcome(const Test&, const RunOptions&)> run = [](const Test& test, const RunOptions& options) {
    return simulate(test, options);
  };
};

/// Sees simulations while a search runs them, so that they need not be run once more to be shown. Called from the
/// threads that simulate.
class RunObserver {
 public:
  using Watch = std::function<void(const Snapshot&)>;

  virtual ~RunObserver() = default;

  /// A simulation that will run to its end; asked in the order of simulations. The answer is called with its moments,
  /// those of the filling first if that is made for it, by one thread.
  virtual Watch begin(const Test& test) = 0;

  /// It has ended, or failed. One that a stop cut off never ends.
  virtual void end(const Test& test, const Outcome& outcome) = 0;

  /// Simulated time between two of its moments.
  virtual double interval_s() const = 0;
};

/// The failure that a test comes to without being simulated: grains that are so soft that their own attraction presses
/// two of them deeper into each other than `RunOptions` lets any be. A search asks before it prepares a candidate: what
/// is poured is smaller the softer it is, without end, and a mould of it has no end either.
std::optional<Failure> too_soft(const Test& test, const RunOptions& options);

}  // namespace pastefit
