#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibrate/exports/export.h"

namespace pastefit {

/// The sources of the style, with the headers of the engine's laws that it is made of: `lammps` of the data folders,
/// and beside it, or where the sources lie, `core` and `calibrate`. Error: in none of them.
Result<std::vector<ExportFile>> lammps_style();

/// The command of a shell, in the folder of these sources, that builds LAMMPS with the style as this file, where
/// Debian's liblammps-dev is installed.
std::string lammps_style_build(const std::string& program);

/// The file of the deck of the whole test.
inline const std::string kLammpsDeck = "in.slump";

/// The dumps that the deck of the whole test leaves: the filled mould, then a heap for each step. None if there is no
/// such deck.
std::vector<std::string> lammps_dumps(const ExportScene& scene);

/// material.inc, in.two_grains and, of a slump test, in.slump and grains.data. The laws are in the words of pair style
/// pastefit (data/lammps). in.two_grains takes two grains of the first class their way (`two_grain_legs`), from an
/// overlap to beyond rupture, and back. It prints "apart DISTANCE FORCE", then "back DISTANCE FORCE" for each,
/// repulsion positive; of elasto-plastic grains "path DISTANCE FORCE". Notes become comments of the first deck.
std::vector<ExportFile> lammps_deck(const ExportScene& scene, const std::vector<std::string>& notes);

/// How a program's `read_data` takes grains.
struct DataFile {
  int types = 1;
  bool by_size = false;      ///< a grain has the type of its size class; else all have the first
  double lowest_m = 0;       ///< of the box, which is wider by four of the largest radii
  double mould_heights = 2;  ///< its top over that of the mould
  const char* style = "";    ///< behind "Atoms"
};

/// The filled mould: id, type, diameter, density, position.
std::string grains_data(const ExportScene& scene, const DataFile& file);

/// Tenth of the Rayleigh time of the smallest grain [s], rounded down to two digits: pi R sqrt(rho/G)/(0.1631 nu +
/// 0.8766). With a viscous bridge at most half of what its dampers are stable with, as those styles do not weaken them;
/// of elasto-plastic grains by the root of k2/k1 shorter, and of `luding` at most a 25th of a collision.
double deck_time_step_s(const ExportScene& scene);

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
