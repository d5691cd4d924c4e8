#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/laws/materials.h"
#include "tests/bench/speed/process.h"

namespace pastefit {

/// What a deck is told, by name.
using Variables = std::vector<std::pair<std::string, std::string>>;

/// Another engine with one choice of laws.
struct Peer {
  enum class TimedEngine { lammps, liggghts, yade };
  TimedEngine engine;
  std::string name;     ///< as in tables and JSON, e.g. "liggghts-capillary"
  std::string program;  ///< looked for on the PATH
  std::string package;  ///< Debian's
  std::string laws;     ///< for a person
  Variables variables;  ///< the laws as the decks want them
};

/// Every peer with its laws nearest to this material: Hertz-Mindlin with friction and rolling resistance; if the
/// material has a bridge, every cohesive law it has that comes near, with the same pull-off force c. An engine that has
/// several such laws stands in the list with each of them, so that the fastest of them is measured, not guessed.
///   LAMMPS DMT: 4 pi gamma R* = c in overlap.  JKR: 3 pi gamma R* = c at separation.  Yade, DMT: as LAMMPS.
///   LIGGGHTS SJKR: pull in proportion to the contact area, equal to c at the overlap where c alone holds a pair.
///   LIGGGHTS capillary (Soulie's bridge): the only one that reaches across a gap; surface tension c/(2 pi R).
/// All of them let go where ours does or earlier.
/// `skin_m`: how much farther than touch pairs are listed; tuned per scene.
std::vector<Peer> peers_of(const ContactModel& material, double radius_m, double skin_m);

/// The command that runs `deck` ("slump", "box", "test") of the peer with these variables.
std::vector<std::string> command_of(const Peer& peer, std::string_view deck, const Variables& variables);

/// Processor seconds of the last loop the peer reports; empty if it did not finish one. LAMMPS and Yade tell the
/// processor's share; of LIGGGHTS the wall time of its loop is known, and the share is that of the whole process
/// without the time it sleeps at its start.
std::optional<double> loop_seconds(const Peer& peer, const ChildResult& run);

/// The last number that follows this label at the start of a line of the output.
std::optional<double> number_after(const std::string& output, std::string_view label);

/// The number as decks read it.
std::string decimal(double value);

}  // namespace pastefit
