#pragma once

#include <string>

namespace pastefit {

/// "0.1.0"
std::string program_version();

/// "pastefit 0.1.0 engine 1f2e3d4c5b6a7988": version, and a fingerprint of the engine's sources and its compiler.
/// Evaluations of programs with the same identity may stand in for each other, bit for bit.
std::string program_identity();

}  // namespace pastefit
