#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "calibrate/batch/batch.h"
#include "core/result.h"

namespace pastefit {

/// Result of a child process.
struct ChildEnd {
  int status = 0;      ///< exit status
  int signal = 0;      ///< signal that killed it; 0: none
  std::string output;  ///< standard output
};

/// Runs this program with these arguments as a child process, as quiet as this one, and waits for its end. The child
/// shares standard error, is asked to end when `stop` becomes true, and does not outlive this process. Throws
/// std::system_error if the process cannot be started.
ChildEnd run_this_program(const std::vector<std::string>& arguments, const std::atomic<bool>& stop);

/// Runs a shell command in `folder` like `run_this_program`, without input. Both outputs go to the file `output`, and
/// into the result. `meanwhile`: called while it runs.
ChildEnd run_in_shell(const std::string& command, const std::filesystem::path& folder,
                      const std::filesystem::path& output, const std::atomic<bool>& stop,
                      const std::function<void()>& meanwhile = {});

/// Calibrates one study with `pastefit calibrate --resume` in a child process, so that a crash does not affect others;
/// a killed process is started again up to twice. `options`: further words of that command. A calibration without a
/// card leaves the reason in its folder (`read_failure`). Nothing is left after a stop, which can be continued. Errors:
/// the reason cannot be written.
Faults calibrate_in_child(const BatchStudy& one, const std::vector<std::string>& options,
                          const std::atomic<bool>& stop);

/// Returns a flag that becomes true at the first Ctrl-C, SIGTERM or SIGHUP, so that a run ends with the best result so
/// far. The second signal kills the program, as by default. Call this once, before starting threads.
const std::atomic<bool>& listen_for_stop();

}  // namespace pastefit
