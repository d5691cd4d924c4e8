#pragma once

#include <string>

#include "core/result.h"

namespace pastefit {

/// "0.1.0"
std::string program_version();

/// "pastefit 0.1.0 engine 1f2e3d4c5b6a7988": version, and a fingerprint of the engine's sources and its compiler.
/// Evaluations of programs with the same identity may stand in for each other, bit for bit.
std::string program_identity();

/// Runs with the kernels that the environment variable `PASTEFIT_KERNELS` names, if it is there and not empty. Error:
/// it names none that this processor runs.
Faults obey_kernels_variable();

}  // namespace pastefit
