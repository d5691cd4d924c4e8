#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "calibrate/batch/batch.h"
#include "core/result.h"

namespace pastefit {

/// Calibrates one study with `pastefit calibrate --resume` in a child process, so that a crash does not affect others;
/// a killed process is started again up to twice. `options`: further words of that command. A calibration without a
/// card leaves the reason in its folder (`read_failure`). Nothing is left after a stop, which can be continued. Errors:
/// the reason cannot be written.
Faults calibrate_in_child(const BatchStudy& one, const std::vector<std::string>& options,
                          const std::atomic<bool>& stop);

/// Several searches of one study.
struct Seeds {
  int count = 0;
  std::vector<std::string> options;  ///< of `pastefit calibrate` for each of them, without seed and folder
  bool resume = false, force = false, json = false;
};

/// Calibrates a study with its seed and the following ones, each in the folder seed-NUMBER of `out`, and prints the
/// cards side by side (`report/comparison.h`). Returns the exit status: success if every material is confirmed.
int calibrate_with_seeds(const Study& study, const std::string& file, const std::string& out, const Seeds& seeds,
                         const std::atomic<bool>& stop);

}  // namespace pastefit
