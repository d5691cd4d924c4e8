#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/search/search.h"

namespace pastefit {

/// What a calibration cost, and what it brought.
struct CalibrationCost {
  double core_s = 0, wall_s = 0;
  int simulations = 0;
  int coarse_simulations = 0;
  double simulation_s = 0;  ///< processor time of a simulation, its share of the fills included
  CalibrationStatus status = CalibrationStatus::failed;
  double confirmed_mm = -1;       ///< misfit on fresh packings; negative: never asked
  double smallest_advised_s = 0;  ///< step that the most demanding candidate asked for
  double median_advised_s = 0;    ///< the candidate in the middle
  /// Of the processor time, spent on heaps after their highest point was 5 mm and a grain's radius, or 40 mm, below the
  /// target.
  double share_below_target = 0, share_far_below_target = 0;
};

/// The files of the mixes that can be calibrated here: "02" is data/studies/concrete-mix-02.json.
std::vector<std::string> mixes();

/// The program's own search of a shipped study up to a confirmed candidate; what it does beyond that (which other
/// materials fit as well) is left out, because the plain search does nothing of the kind.
/// `coarse_first`: as the study option of this name. `store`: file for its evaluations, not there yet.
CalibrationCost calibrate_ours(const std::string& mix, std::uint64_t seed, bool coarse_first,
                               const std::filesystem::path& store);

/// The same study to the same confirmed misfit as a script around any DEM program does it: Nelder and Mead's simplex
/// from the middle of the bounds; every simulation fills its own mould under its own parameters, takes `fixed_step_s`
/// (the smallest that a candidate of our search asked for) and waits for fixed times; every candidate on all packings.
/// Four times the study's budget. Kind to the script: the fill takes our own step, and a wait is half a second, which
/// is not enough for every candidate to come to rest.
CalibrationCost calibrate_plainly(const std::string& mix, std::uint64_t seed, const std::filesystem::path& store,
                                  double fixed_step_s);

}  // namespace pastefit
