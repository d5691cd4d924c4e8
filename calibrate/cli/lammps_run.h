#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

#include "calibrate/exports/export.h"
#include "calibrate/exports/lammps_log.h"
#include "core/observe/readings.h"

namespace pastefit {

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
