#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace pastefit {

/// Properties of the machine that may change the bits of a simulation: processor family, availability of fused
/// multiply-add functions to the C library, and that library's version, e.g. "x86_64 fma glibc 2.36" (core/README.md,
/// Determinism).
std::string machine_type();

/// Processors available to the program, at least 1.
int processors();

/// Memory available to programs [bytes]; infinite if unknown.
double memory_available_bytes();

/// Processor time [s], by POSIX clock, of the calling thread or of the process.
inline double processor_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
inline double thread_seconds() {
  return processor_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/// Keeps freed memory in the process, which avoids system calls for lists that are rebuilt hundreds of times a second:
/// 5 to 10 % of a flowing slump. Call this once, at the start. Limits: GNU C library only; no effect elsewhere.
void keep_freed_memory();

/// Search path of the program's data (apparatus, cases, LAMMPS style), in order: the environment variable
/// PASTEFIT_DATA_DIR; `share/pastefit` beside the program's folder, so that an installed tree can be moved, or beside a
/// parent folder of the shared library that contains this code; the source tree (not in packages); the configured
/// folder. They need not exist.
std::vector<std::filesystem::path> data_folders();

}  // namespace pastefit
