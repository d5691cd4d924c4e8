#include "tests/bench/speed/process.h"

#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <sstream>

namespace pastefit {

namespace {

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = write(file, text.data() + done, text.size() - done);
    if (n <= 0) return;
    done += static_cast<std::size_t>(n);
  }
}

std::string read_all(int file) {
  std::string text;
  char buffer[1 << 14];
  for (ssize_t n = 0; (n = read(file, buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<std::size_t>(n));
  return text;
}

/// Forks; `body` writes into the pipe it is given and returns the exit status.
ChildResult run_child(const std::function<int(int)>& body, unsigned limit_s) {
  ChildResult result;
  int ends[2];
  if (pipe(ends) != 0) {
    result.output = std::string("no pipe: ") + std::strerror(errno);
    return result;
  }
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    alarm(limit_s);  // outlives exec
    _exit(body(ends[1]));
  }
  close(ends[1]);
  if (child < 0) {
    result.output = std::string("no process: ") + std::strerror(errno);
    close(ends[0]);
    return result;
  }
  result.output = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.processor_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peak_bytes = 1024 * static_cast<std::int64_t>(usage.ru_maxrss);
  result.ok = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (WIFSIGNALED(status))
    result.output += WTERMSIG(status) == SIGALRM ? "\nended: it took longer than " + std::to_string(limit_s) + " s"
                                                 : "\nended by signal " + std::to_string(WTERMSIG(status));
  return result;
}

}  // namespace

ChildResult run_program(const std::vector<std::string>& command, unsigned limit_s) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  return run_child(
      [&](int out) {
        dup2(out, STDOUT_FILENO);
        dup2(out, STDERR_FILENO);
        close(out);
        dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
        setenv("OMP_NUM_THREADS", "1", 1);
        setenv("PYTHONDONTWRITEBYTECODE", "1", 1);  // no litter beside the decks
        execvp(arguments[0], arguments.data());
        const std::string reason = command[0] + ": " + std::strerror(errno);
        write_all(STDOUT_FILENO, reason);
        return 127;
      },
      limit_s);
}

ChildResult run_function(const std::function<std::string()>& function, unsigned limit_s) {
  return run_child(
      [&](int out) {
        // Large blocks go back to the system, as in a new process. The parent's allocator has seen the output of peers
        // come and go, and would keep them: 30 bytes a grain of the settled box.
        mallopt(M_MMAP_THRESHOLD, 128 * 1024);
        try {
          write_all(out, function());
          return 0;
        } catch (const std::exception& problem) {
          write_all(out, problem.what());
          return 1;
        }
      },
      limit_s);
}

bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace pastefit
