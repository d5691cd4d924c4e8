#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/exports/export.h"

namespace pastefit {

/// The law of a wall, for the variable NAME_law of a material file.
struct LammpsWall {
  std::string name;  ///< of its region
  std::string law;   ///< words of the fix
};

/// The contact laws of a scene in the words of pair style pastefit (data/lammps); everything else of a deck does not
/// depend on them.
struct LammpsLaws {
  std::string guard;              ///< commands that stop a program which would misread the deck
  std::string pairs;              ///< pair style and coefficients
  std::vector<LammpsWall> walls;  ///< in the order of `walls_in_deck`
};

/// The sources of the style, with the headers of the engine's laws that it is made of: `lammps` of the data folders,
/// and beside it, or where the sources lie, `core` and `calibrate`. Error: in none of them.
Result<std::vector<ExportFile>> lammps_style();

/// The command of a shell, in the folder of these sources, that builds LAMMPS with the style as this file, where
/// Debian's liblammps-dev is installed.
std::string lammps_style_build(const std::string& program);

/// material.inc: the laws alone, to be included once the grains are there, by the decks and by scripts of others.
std::string material_file(const ExportScene& scene, const LammpsLaws& laws);

/// The slump test: relax in the mould, lift, rest; and, where the card has a drop plate, step 2: turn the plate up,
/// rest, let it fall, rest. Notes become comments.
std::string slump_deck(const ExportScene& scene, const LammpsLaws& laws, const std::vector<std::string>& notes);

/// The file of the deck of the whole test.
inline const std::string kLammpsDeck = "in.slump";

/// The dumps that the deck of the whole test leaves: the filled mould, then a heap for each step. None if there is no
/// such deck.
std::vector<std::string> lammps_dumps(const ExportScene& scene);

/// Two grains of the first class on their way (`two_grain_legs`): from an overlap to beyond rupture, and back. Prints
/// "apart DISTANCE FORCE", then "back DISTANCE FORCE" for each, repulsion positive; of elasto-plastic grains "path
/// DISTANCE FORCE". Where there is no other deck it has the notes.
std::string two_grains_deck(const ExportScene& scene, const std::vector<std::string>& notes);

/// material.inc, in.two_grains and, of a slump test, in.slump and grains.data with these radii.
std::vector<ExportFile> lammps_deck(const ExportScene& scene, const LammpsLaws& laws,
                                    const std::vector<std::string>& notes, std::span<const double> radii_m);

/// The filled mould: id, type, diameter, density, position. Types are size classes; `radii_m` one for each grain.
std::string grains_data(const ExportScene& scene, std::span<const double> radii_m);

/// The walls of the test; of a slump test besides the ground, where grains land that flow over the table's edge.
std::vector<ExportWall> walls_in_deck(const ExportScene& scene);

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
