#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "calibrate/exports/export.h"
#include "calibrate/exports/lammps_deck.h"
#include "core/observe/readings.h"
#include "core/result.h"

namespace pastefit {

/// Whether a program of this name can be started: a path, or a name that is looked for in PATH.
bool is_program(const std::string& name);

/// LAMMPS with the card's laws as styles: the program that the user gave, or one that is built from the shipped sources
/// and kept in `pastefit` of the user's cache (XDG_CACHE_HOME, else ~/.cache) for as long as sources and headers stay
/// the same.
/// Errors: there is no such program; what is needed to build one is missing, all at once; it does not compile.
Result<std::filesystem::path> lammps_program(const std::string& given, const std::atomic<bool>& stop);

/// How a deck is started.
struct LammpsLaunch {
  std::string launcher;  ///< words of a shell that stand before the program, e.g. "mpirun -n 16"; empty: one rank
  std::filesystem::path program;
};

/// A heap that LAMMPS left, as pastefit reads it.
struct LammpsHeap {
  Readings readings;
  LammpsLog log;
};

/// Simulates a test in LAMMPS with the card's laws: writes the deck to `folder`, runs it there, reads the heap.
/// A folder in which the same deck ran well before is only read. What LAMMPS said is in output.txt and log.lammps.
/// Errors: laws that the deck cannot express; the folder cannot be written; the program does not end well, loses
/// grains, leaves no heap, or runs as several copies because the launcher is of another MPI. Each in one message.
/// Requirement: there is a deck of the whole test (`has_deck`).
Result<LammpsHeap> run_in_lammps(const ExportScene& scene, const LammpsLaunch& launch,
                                 const std::filesystem::path& folder, const std::atomic<bool>& stop);

}  // namespace pastefit
