#pragma once

#include <string>
#include <string_view>

namespace pastefit {

/// What the log of LAMMPS tells of a run.
struct LammpsLog {
  std::string program;  ///< its first line, e.g. "LAMMPS (29 Sep 2021 - Update 2)"; empty: there is none
  int copies = 0;       ///< how often that line stands there: in the output of one run once
  int ranks = 0;        ///< of the time steps; 0: none were made
  double wall_s = 0;    ///< of all time steps
  double core_s = 0;    ///< processor time of all ranks in them
  std::string error;    ///< the first line that begins with "ERROR"; empty: there is none
  bool ended = false;   ///< it wrote its last line
};

/// Reads a log.lammps, or what LAMMPS wrote to its standard output. Of each `run` it takes the lines "Loop time of ...
/// on
/// ... procs" and "... % CPU use", which is the mean over the ranks (LAMMPS manual, "Screen and logfile output"); where
/// that is not written, all ranks are taken to have worked all the time.
LammpsLog read_lammps_log(std::string_view text);

}  // namespace pastefit
