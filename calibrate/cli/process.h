#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pastefit {

/// How a child process ended.
struct ChildEnd {
  int status = 0;      ///< exit status
  int signal = 0;      ///< that killed it; 0: none
  std::string output;  ///< what it wrote to standard output
};

/// Runs this program again with these arguments, as a process of its own, and waits for its end. Its standard error is
/// that of this process. Once `stop` is true it is asked to end, and waited for; it does not outlive this process.
/// Throws std::system_error if no process can be started.
ChildEnd run_this_program(const std::vector<std::string>& arguments, const std::atomic<bool>& stop);

/// Runs a command of the shell in `folder` and waits for its end, as above; it reads nothing. Both of its outputs go to
/// the file `output`, and into the answer. `meanwhile`: called while it runs.
ChildEnd run_in_shell(const std::string& command, const std::filesystem::path& folder,
                      const std::filesystem::path& output, const std::atomic<bool>& stop,
                      const std::function<void()>& meanwhile = {});

/// Becomes true at the first Ctrl-C, SIGTERM or SIGHUP, so that a run ends with the best so far; the second one kills,
/// as usual. Call once, before threads are started.
const std::atomic<bool>& listen_for_stop();

}  // namespace pastefit
