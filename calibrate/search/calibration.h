#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibrate/evaluate/response.h"

namespace pastefit {

/// How a calibration ended.
enum class CalibrationStatus {
  confirmed,     ///< the best candidate meets the laboratory within the tolerance on fresh packings, noise or not
  unconfirmed,   ///< it does not for certain, and the budget is spent or the search is at its end
  out_of_reach,  ///< some reading lies beyond everything the model did in these bounds
  stopped,       ///< the user or a limit asked for it; the best so far is given
  failed         ///< no candidate could be simulated
};

/// The status as it is stored and printed, e.g. "out_of_reach".
std::string_view name_of(CalibrationStatus status);

/// Where a search is, for a person who waits.
struct Progress {
  std::string_view phase;  ///< "screening", "search", "refinement", "confirmation"
  int simulations = 0;     ///< done
  int budget = 0;          ///< allowed in all
  double best_error = -1;  ///< of the best candidate so far, in tolerances; negative: none yet
  std::string note;        ///< something to be told once; mostly empty
};

/// What the model did with one reading in all simulations that ended well.
struct Reach {
  double lowest = 0, highest = 0;  ///< of one simulation, in the reading's unit
  bool all_above = false;          ///< every simulation, coarse ones corrected, read too much
  bool all_below = false;          ///< every simulation, coarse ones corrected, read too little
  double packing_noise = 0;        ///< standard deviation from packing to packing, same parameters; 0: not seen
};

/// What a search brought.
struct Calibration {
  Response best;          ///< the reported candidate on every packing it was simulated on
  Response search;        ///< the same on the packings it was found with
  Response confirmation;  ///< the same on fresh packings that the search had not used; no point if never confirmed
  CalibrationStatus status = CalibrationStatus::failed;
  std::string reason;             ///< one or more sentences for a person
  std::vector<Response> history;  ///< every answer, in the order of asking, each point with its set of packings
  std::vector<Reach> reach;       ///< one for each reading
  int simulations = 0;            ///< spent
  int coarse_simulations = 0;     ///< with coarse grains, besides
  int failures = 0;               ///< of them failed
  int rounds = 0;                 ///< confirmations
};

}  // namespace pastefit
