#pragma once

#include <string>

#include "core/result.h"

namespace pastefit {

/// "0.1.0"
std::string program_version();

/// "pastefit 0.1.0 engine 1f2e3d4c5b6a7988": version, and fingerprint of the engine's sources and compiler. Programs of
/// equal identity give the same evaluations, bit for bit.
std::string program_identity();

/// Selects the kernels named by the environment variable `PASTEFIT_KERNELS`, if set and not empty. Error: this
/// processor does not run them.
Faults obey_kernels_variable();

}  // namespace pastefit
