#include "calibrate/cli/standard_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <string>

#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace {

int first_error = 0;  // of writing to standard output
bool quiet = false;

void note_error(bool failed) {
  if (failed && first_error == 0) first_error = errno;
}

[[gnu::format(printf, 1, 0)]] std::string harmless(const char* pattern, va_list values) {
  va_list again;
  va_copy(again, values);
  std::string text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, pattern, values)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  return lines_of(text);
}

}  // namespace

void print(const char* pattern, ...) {
  va_list values;
  va_start(values, pattern);
  note_error(std::fputs(harmless(pattern, values).c_str(), stdout) < 0);
  va_end(values);
}

void note(const char* pattern, ...) {
  va_list values;
  va_start(values, pattern);
  if (!quiet) {
    note_error(std::fflush(stdout) != 0);  // where both go to one place, in the order in which they were said
    std::fputs(for_terminal(harmless(pattern, values)).c_str(), stderr);
  }
  va_end(values);
}

void be_quiet() {
  quiet = true;
}

bool is_quiet() {
  return quiet;
}

void guard_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0)  // for standard output: so that writing to it fails
      static_cast<void>(::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // beyond a limit on file sizes writing fails, which is told
}

int after_output(int status) {
  note_error(std::fflush(stdout) != 0);
  if (first_error == 0 && std::ferror(stdout) == 0) return status;
  const char* why = first_error != 0 ? std::strerror(first_error) : "an error of writing";
  if (first_error != EPIPE) std::fprintf(stderr, "pastefit: standard output did not take everything: %s\n", why);
  return status == kDone ? kFailed : status;
}

}  // namespace pastefit
