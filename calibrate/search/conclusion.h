#pragma once

#include <optional>
#include <span>
#include <string>

#include "calibrate/search/calibration.h"
#include "calibrate/search/reachability.h"

namespace pastefit {

/// Outcome of a search, from which its status follows.
struct Ending {
  bool confirmed = false;     ///< the last confirmation succeeded
  bool stopped = false;       ///< by the user or a limit
  bool any_feasible = false;  ///< at least one simulation is feasible
  bool with_coarse = false;   ///< coarse grains were simulated
  bool searched = true;       ///< false: ended after the screening
  std::optional<OutOfReach> out_of_reach = std::nullopt;
  double rejected_share = 1;   ///< largest share of rejected heaps; 1: not judged
  bool some_censored = false;  ///< at least one simulation is censored
};

/// Sets status and reason of a calibration. Requirement: all other fields of `result` are set. `unit`: of errors in the
/// text. `readings`, `parameters`: names; may be empty.
void explain(Calibration& result, const Ending& ending, const ErrorUnit& unit, std::span<const std::string> readings,
             std::span<const std::string> parameters);

}  // namespace pastefit
