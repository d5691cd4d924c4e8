#include "calibrate/exports/lammps_log.h"

#include <algorithm>
#include <cstdio>

namespace pastefit {

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
    } else if (std::sscanf(line.c_str(), "Loop time of %lf on %d procs", &seconds, &ranks) == 2) {
      end_of_loop();
      loop_s = std::max(0.0, seconds);
      log.ranks = std::max(log.ranks, ranks);
    } else if (line.find("% CPU use") != std::string::npos && std::sscanf(line.c_str(), "%lf", &percent) == 1 &&
               percent > 0) {
      share = percent / 100;
    } else if (line.starts_with("Total wall time:")) {
      log.ended = true;
    }
  }
  end_of_loop();
  return log;
}

}  // namespace pastefit
