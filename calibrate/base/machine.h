#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace pastefit {

/// What of the machine the bits of a simulation may depend on, besides the program: processor family, whether the C
/// library may use its fused multiply-add functions there, and that library's version, e.g. "x86_64 fma glibc 2.36"
/// (core/README.md, Determinism).
std::string machine_type();

/// Processors of this machine that the program may use, at least 1.
int processors();

/// Memory that programs may still take [bytes]; infinite where the system does not say.
double memory_available_bytes();

/// Time that processors have worked [s], by POSIX's clock of the calling thread or of the whole process.
inline double processor_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
inline double thread_seconds() {
  return processor_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/// Keeps memory that was given up in the process, so that lists made anew hundreds of times a second need not ask the
/// system for it, page by page: 5 to 10 % of a flowing slump. To be called once, at the beginning of a program.
/// Limits: with the GNU C library; elsewhere nothing happens.
void keep_freed_memory();

/// Where the program's data may be (apparatus, cases, the style for LAMMPS), the first that counts first: the folder
/// that the environment variable PASTEFIT_DATA_DIR names; `share/pastefit` beside the program's own folder, so that an
/// installed tree may be moved, or beside a folder above that of the shared library this is in; the sources' (not in
/// packages); the folder that was configured. None of them need be there.
std::vector<std::filesystem::path> data_folders();

}  // namespace pastefit
