#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibrate/evaluate/response.h"

namespace pastefit {

/// How a calibration ended.
enum class CalibrationStatus {
  confirmed,     ///< on fresh packings every reading is within its tolerance, replicate scatter included
  unconfirmed,   ///< not confirmed when the budget was spent or the search ended
  out_of_reach,  ///< a reading cannot be reached within the bounds
  stopped,       ///< stopped by the user or a limit; `best` is the best so far
  failed         ///< no candidate could be simulated
};

/// Name in files and messages, e.g. "out_of_reach".
std::string_view name_of(CalibrationStatus status);

struct Progress {
  std::string phase;       ///< "screening", "search", "refinement", "confirmation"
  int simulations = 0;     ///< finished
  int budget = 0;          ///< total allowed
  double best_error = -1;  ///< of the best candidate so far; negative: none yet
  std::string note;        ///< one-time message; usually empty
};

/// Range of one reading over all feasible simulations.
struct Reach {
  double lowest = 0, highest = 0;  ///< [unit of the reading]
  bool all_above = false;          ///< all simulations, coarse ones corrected, exceed measurement plus tolerance
  bool all_below = false;          ///< all simulations, coarse ones corrected, are below measurement less tolerance
};

struct Calibration {
  Response best;          ///< recommended candidate on all its packings
  Response search;        ///< the same on the packings before its confirmation
  Response confirmation;  ///< the same on fresh packings; no point if never confirmed
  CalibrationStatus status = CalibrationStatus::failed;
  std::string reason;             ///< one or more sentences for the user
  std::vector<Response> history;  ///< all responses in the order of asking, each with its packings
  std::vector<Reach> reach;       ///< of each reading
  int simulations = 0;            ///< spent
  int coarse_simulations = 0;     ///< with coarse grains
};

}  // namespace pastefit
