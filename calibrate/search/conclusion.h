#pragma once

#include <optional>
#include <span>
#include <string>

#include "calibrate/search/calibration.h"
#include "calibrate/search/reachability.h"

namespace pastefit {

/// How a search came to its end.
struct Ending {
  bool confirmed = false;     ///< the last confirmation held
  bool stopped = false;       ///< by the user or a limit
  bool any_feasible = false;  ///< some simulation did not fail
  bool with_coarse = false;   ///< coarse grains were simulated too
  bool searched = true;       ///< else the screening was enough
  std::optional<OutOfReach> out_of_reach = std::nullopt;
  double rejected_share = 1;   ///< of a candidate's heaps, at most; 1: not judged
  bool some_censored = false;  ///< of the simulations
};

/// Gives a calibration its status and the reason for it, in sentences for a person. Requirements: everything else in
/// `result` is there. `unit`: for people. `readings`, `parameters`: names; may be left empty.
void explain(Calibration& result, const Ending& ending, const ErrorUnit& unit, std::span<const std::string> readings,
             std::span<const std::string> parameters);

}  // namespace pastefit
