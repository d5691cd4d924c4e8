#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.h"

namespace pastefit {

/// The fault of a command that would compute for more than a day: `processor_s` at least, on so many threads (0: one
/// for each processor). `work`: what takes it, e.g. "7.6e+06 grains". Empty with `force`, and where it takes no more;
/// what takes more than an hour is then said on standard error.
Faults long_run_faults(const std::string& where, const std::string& work, double processor_s, int threads, bool force,
                       const std::string& remedy);

/// The fault of pictures that do not fit on the disk of a folder, which need not be there yet. Empty with `force`.
Faults picture_faults(const std::filesystem::path& folder, double pictures, double grains, bool force);

}  // namespace pastefit
