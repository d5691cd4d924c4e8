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

}  // namespace pastefit
