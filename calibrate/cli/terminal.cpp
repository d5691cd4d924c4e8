#include "calibrate/cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "calibrate/base/text.h"

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
  const std::size_t most = columns() - 1;  // the last column would begin a new line
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

}  // namespace pastefit
