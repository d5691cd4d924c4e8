#pragma once

#include <functional>

#include "calibrate/laboratory/test.h"

namespace pastefit {

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

}  // namespace pastefit
