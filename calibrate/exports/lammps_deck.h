#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/exports/export.h"

namespace pastefit {

/// Sources of the LAMMPS style with the headers of the engine's laws: `lammps` of the data folders, with `core` and
/// `calibrate` in it or beside the sources. Error: not found.
Result<std::vector<ExportFile>> lammps_style();

/// Shell command that builds LAMMPS with the style as `program` in the folder of these sources, with Debian's
/// liblammps-dev installed.
std::string lammps_style_build(const std::string& program);

/// Deck of the whole test.
inline const std::string kLammpsDeck = "in.slump";

/// Dumps of the deck of the whole test: the filled mould, then a heap for each step. Empty without such a deck.
std::vector<std::string> lammps_dumps(const ExportScene& scene);

/// Writes material.inc, in.two_grains and, for a slump test, in.slump and grains.data, for pair style pastefit
/// (data/lammps). in.two_grains moves two grains of the first class (`two_grain_legs`) from an overlap to beyond
/// rupture, and back; it prints "apart DISTANCE FORCE", then "back DISTANCE FORCE", repulsion positive; for
/// elasto-plastic grains "path DISTANCE FORCE". Notes become comments of the first deck.
std::vector<ExportFile> lammps_deck(const ExportScene& scene, const std::vector<std::string>& notes);

/// Format of grains for a program's `read_data`.
struct DataFile {
  int types = 1;
  bool by_size = false;      ///< type by size class; otherwise all grains have the first type
  double lowest_m = 0;       ///< lower end of the box, which is wider by four of the largest radii
  double mould_heights = 2;  ///< top of the box over the mould's height
  const char* style = "";    ///< after "Atoms"
};

/// The filled mould: id, type, diameter, density, position.
std::string grains_data(const ExportScene& scene, const DataFile& file);

/// Tenth of the Rayleigh time of the smallest grain [s], rounded down to two digits: pi R sqrt(rho/G)/(0.1631 nu +
/// 0.8766). Viscous bridge: at most half of the stability limit of its dampers, which those styles do not weaken.
/// Elasto-plastic grains: shorter by the root of k2/k1; `luding`: at most a 25th of a collision.
double deck_time_step_s(const ExportScene& scene);

struct LammpsLog {
  std::string program;                    ///< first line, e.g. "LAMMPS (29 Sep 2021 - Update 2)"; may be empty
  int copies = 0;                         ///< occurrences of that line: one per run
  int ranks = 0;                          ///< of the time steps; 0: no steps
  double wall_s = 0;                      ///< of all time steps
  double core_s = 0;                      ///< processor time of all ranks in them
  std::optional<double> slide_angle_deg;  ///< of a tilted table, as the deck prints it
  std::string error;                      ///< first line beginning with "ERROR"; may be empty
  bool ended = false;                     ///< the last line was written
};

/// Parses a log.lammps, or the standard output of LAMMPS. Of each `run` it takes the lines "Loop time of ... on ...
/// procs" and "... % CPU use", the mean over the ranks (LAMMPS manual, "Screen and logfile output"); without the
/// latter, 100 %.
LammpsLog read_lammps_log(std::string_view text);

}  // namespace pastefit
