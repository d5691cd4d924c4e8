#include "calibrate/cli/process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <thread>

#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace {

std::atomic<bool> stop_requested = false;

extern "C" void request_stop(int) {
  stop_requested = true;
}

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

constexpr int kNotStarted = 127;  // same as in shells

std::string content_of(int file) {
  std::string out;
  std::array<char, 1 << 16> part{};
  ::lseek(file, 0, SEEK_SET);
  for (ssize_t size = 0; (size = ::read(file, part.data(), part.size())) > 0;)
    out.append(part.data(), static_cast<std::size_t>(size));
  return out;
}

/// Waits for the child. Its handler accepts each signal once. Ctrl-C (SIGINT) and Slurm (SIGTERM) already signal both
/// processes, so SIGHUP is the one still available.
int wait_for(pid_t child, const std::atomic<bool>& stop, const std::function<void()>& meanwhile) {
  bool told = false;
  int state = 0;
  for (;;) {
    const pid_t ended = ::waitpid(child, &state, WNOHANG);
    if (ended == child) return state;
    if (ended < 0 && errno != EINTR) fail("waitpid");
    if (stop && !told) {
      ::kill(child, SIGHUP);
      told = true;
    }
    if (meanwhile) meanwhile();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/// Forks a process that calls `become`, which must not return, and waits for its end.
template <class Become>
ChildEnd run_child(int output, const std::atomic<bool>& stop, const std::function<void()>& meanwhile, Become become) {
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) fail("fork");
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() == parent) become();
    ::_exit(kNotStarted);
  }
  const int state = wait_for(child, stop, meanwhile);
  ChildEnd end;
  if (WIFSIGNALED(state))
    end.signal = WTERMSIG(state);
  else
    end.status = WEXITSTATUS(state);
  end.output = content_of(output);
  ::close(output);
  return end;
}

constexpr int kMostDeaths = 3;  // of one calibration's process; as for a worker

/// Reason for a missing card from the end of the process; nothing if there is a card.
std::optional<BatchFailure> failure_after(const BatchStudy& one, const ChildEnd& end) {
  if (end.signal != 0)
    return BatchFailure{"failed", format("its process was killed by signal %d, ", end.signal) +
                                      format("%d times; the same command goes on with it", kMostDeaths)};
  if (end.status != kDone && end.status != kFailed)
    return BatchFailure{"failed", format("ended with status %d; to see why: ", end.status) + "pastefit calibrate " +
                                      shell_word(one.file.string()) + " --resume --out " +
                                      shell_word(one.folder.string())};
  const auto answer = nlohmann::json::parse(end.output, nullptr, false);
  if (answer.is_object() && answer.contains("format")) return std::nullopt;
  if (!answer.is_object() || !answer.contains("reason"))
    return BatchFailure{"failed", "it could not write its result to " + one.folder.string()};
  return BatchFailure{answer.value("status", "failed"), answer.value("reason", "")};
}

}  // namespace

ChildEnd run_this_program(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  std::vector<std::string> words{"pastefit"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  if (is_quiet()) words.push_back("--quiet");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int output = ::memfd_create("pastefit-output", MFD_CLOEXEC);
  if (output < 0) fail("memfd_create");
  return run_child(output, stop, {}, [&] {
    ::dup2(output, STDOUT_FILENO);
    ::execv("/proc/self/exe", argv.data());
  });
}

ChildEnd run_in_shell(const std::string& command, const std::filesystem::path& folder,
                      const std::filesystem::path& output_file, const std::atomic<bool>& stop,
                      const std::function<void()>& meanwhile) {
  const int output = ::open(output_file.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (output < 0) fail("open");
  return run_child(output, stop, meanwhile, [&] {
    const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (nothing < 0 || ::chdir(folder.c_str()) != 0) return;
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(output, STDOUT_FILENO);
    ::dup2(output, STDERR_FILENO);
    ::execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
  });
}

Faults calibrate_in_child(const BatchStudy& one, const std::vector<std::string>& options,
                          const std::atomic<bool>& stop) {
  std::vector<std::string> words{"calibrate", one.file.string(), "--out", one.folder.string(), "--resume", "--json"};
  words.insert(words.end(), options.begin(), options.end());
  std::error_code error;
  std::filesystem::remove(one.folder / kFailureFile, error);
  ChildEnd end;
  try {
    for (int deaths = 0; deaths < kMostDeaths; ++deaths) {
      end = run_this_program(words, stop);
      if (end.signal == 0 || stop) break;
      note("pastefit: %s: the process was killed by signal %d\n", one.name.c_str(), end.signal);
    }
  } catch (const std::system_error& failed) {
    return write_failure(one, {"failed", std::string("no process could be started: ") + failed.what()});
  }
  if (end.signal != 0 && stop) return {};  // can be continued
  if (const auto failure = failure_after(one, end)) return write_failure(one, *failure);
  std::filesystem::remove(one.folder / kFailureFile, error);  // written by a concurrent batch
  return {};
}

const std::atomic<bool>& listen_for_stop() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);
  return stop_requested;
}

}  // namespace pastefit
