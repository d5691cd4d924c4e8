#include "calibrate/exports/lammps_log.h"

#include <algorithm>
#include <locale>
#include <sstream>
#include <string>

namespace pastefit {

namespace {

/// The words of a line, numbers as in C whatever the locale.
std::istringstream line_stream(const std::string& line) {
  std::istringstream words(line);
  words.imbue(std::locale::classic());
  return words;
}

/// "Loop time of 1.5 on 2 procs ...".
bool is_loop(const std::string& line, double& seconds, int& ranks) {
  std::string loop, time, of, on;
  auto words = line_stream(line);
  words >> loop >> time >> of >> seconds >> on >> ranks;
  constexpr double longest_s = 1e9;
  constexpr int most_ranks = 10'000'000;
  const bool possible = seconds >= 0 && seconds <= longest_s && ranks >= 1 && ranks <= most_ranks;
  return words && possible && loop == "Loop" && time == "time" && of == "of" && on == "on";
}

/// "99.5% CPU use with ...".
bool is_share(const std::string& line, double& percent) {
  constexpr double most_percent = 1e5;
  return line.find("% CPU use") != std::string::npos && line_stream(line) >> percent && percent > 0 &&
         percent <= most_percent;
}

}  // namespace

LammpsLog read_lammps_log(std::string_view text) {
  LammpsLog log;
  double loop_s = 0, share = 1;
  const auto end_of_loop = [&] {
    log.wall_s += loop_s;
    log.core_s += loop_s * share * log.ranks;
    loop_s = 0;
    share = 1;
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    double seconds = 0, percent = 0;
    int ranks = 0;
    if (line.starts_with("LAMMPS (")) {
      if (log.copies++ == 0) log.program = line;
    } else if (line.starts_with("ERROR")) {
      if (log.error.empty()) log.error = line;
    } else if (is_loop(line, seconds, ranks)) {
      end_of_loop();
      loop_s = std::max(0.0, seconds);
      log.ranks = std::max(log.ranks, ranks);
    } else if (is_share(line, percent)) {
      share = percent / 100;
    } else if (line.starts_with("Total wall time:")) {
      log.ended = true;
    }
  }
  end_of_loop();
  return log;
}

}  // namespace pastefit
