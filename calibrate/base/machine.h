#pragma once

#include <string>

namespace pastefit {

/// What of the machine the bits of a simulation may depend on, besides the program: processor family, whether the C
/// library may use its fused multiply-add functions there, and that library's version, e.g. "x86_64 fma glibc 2.36"
/// (core/README.md, Determinism).
std::string machine_type();

/// Processors of this machine that the program may use, at least 1.
int processors();

/// Memory that programs may still take [bytes]; infinite where the system does not say.
double memory_available_bytes();

}  // namespace pastefit
