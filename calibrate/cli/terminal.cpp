#include "calibrate/cli/terminal.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"

namespace pastefit {

namespace {

constexpr double kLongestToldDays = 999;

std::string time_in_words(double seconds) {
  if (seconds < 99.5) return format("%.0f s", seconds);
  if (seconds < 99.5 * 60) return format("%.0f min", seconds / 60);
  if (seconds < 99.5 * 3600) return format("%.0f h", seconds / 3600);
  if (seconds < kLongestToldDays * 86400) return format("%.0f days", seconds / 86400);
  return "years";
}

int first_error = 0;  // on writing to standard output
bool quiet = false;

void note_error(bool failed) {
  if (failed && first_error == 0) first_error = errno;
}

[[gnu::format(printf, 1, 0)]] std::string formatted(const char* pattern, va_list values) {
  va_list again;
  va_copy(again, values);
  std::string text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, pattern, values)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  return text;
}

}  // namespace

bool is_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && kind && std::string_view(kind) != "dumb";
}

std::size_t columns() {
  winsize window{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
  return known ? window.ws_col : 80;
}

std::string for_terminal(const std::string& text) {
  return is_terminal() ? wrapped(text, columns()) : text;
}

std::string fitted(const std::vector<std::string>& parts) {
  const std::size_t most = columns() - 1;  // the last column would wrap
  std::string line = parts.front().substr(0, most);
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (!parts[i].empty() && line.size() + 2 + parts[i].size() <= most) line += ", " + parts[i];
  return line;
}

std::string range_of_time(double least_s, double most_s) {
  std::string least = time_in_words(least_s);
  const std::string most = time_in_words(most_s);
  if (least == most) return least;
  if (most == "years") return least + " or more";
  const auto unit = [](const std::string& words) { return words.substr(words.find(' ')); };
  return (unit(least) == unit(most) ? least.substr(0, least.find(' ')) : least) + " to " + most;
}

void print(const std::string& text) {
  note_error(std::fputs(lines_of(text).c_str(), stdout) < 0);
}

void print(const char* pattern, ...) {
  va_list values;
  va_start(values, pattern);
  print(formatted(pattern, values));
  va_end(values);
}

void note(const std::string& text) {
  if (quiet) return;
  note_error(std::fflush(stdout) != 0);  // keeps the order if both streams share a target
  std::fputs(for_terminal(lines_of(text)).c_str(), stderr);
}

void note(const char* pattern, ...) {
  va_list values;
  va_start(values, pattern);
  note(formatted(pattern, values));
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
    if (::fcntl(stream, F_GETFD) < 0)  // so that writing to standard output fails
      static_cast<void>(::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // writing beyond a file size limit fails, which is reported
}

int after_output(int status) {
  note_error(std::fflush(stdout) != 0);
  if (first_error == 0 && std::ferror(stdout) == 0) return status;
  const char* why = first_error != 0 ? std::strerror(first_error) : "an error of writing";
  if (first_error != EPIPE) std::fprintf(stderr, "pastefit: standard output did not take everything: %s\n", why);
  return status == kDone ? kFailed : status;
}

}  // namespace pastefit
