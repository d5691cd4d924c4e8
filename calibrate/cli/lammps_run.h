#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "calibrate/exports/export.h"
#include "calibrate/exports/lammps_deck.h"
#include "core/observe/readings.h"
#include "core/result.h"

namespace pastefit {

/// True if a program of this name can be started: a path, or a name in PATH.
bool is_program(const std::string& name);

/// LAMMPS with the card's laws as styles: `given`, or a build of the shipped sources, cached in `pastefit` of the
/// user's cache (XDG_CACHE_HOME, else ~/.cache) until sources or headers change. Errors: no such program; all missing
/// build requirements; a failed compilation.
Result<std::filesystem::path> lammps_program(const std::string& given, const std::atomic<bool>& stop);

/// How to start a deck.
struct LammpsLaunch {
  std::string launcher;  ///< shell words before the program, e.g. "mpirun -n 16"; empty: one rank
  std::filesystem::path program;
};

/// Final heap of a LAMMPS run, read by pastefit.
struct LammpsHeap {
  Readings readings;
  LammpsLog log;
};

/// Simulates a test in LAMMPS with the card's laws: writes the deck to `folder`, runs it there, and reads the heap. If
/// the same deck has already completed in the folder, its heap is only read. The output of LAMMPS is in output.txt and
/// log.lammps. Requirement: a deck of the whole test exists (`has_deck`). Errors, each in one message: laws that the
/// deck cannot express; the folder cannot be written; the program fails, loses grains, leaves no heap, or runs as
/// several copies because the launcher belongs to another MPI.
Result<LammpsHeap> run_in_lammps(const ExportScene& scene, const LammpsLaunch& launch,
                                 const std::filesystem::path& folder, const std::atomic<bool>& stop);

}  // namespace pastefit
