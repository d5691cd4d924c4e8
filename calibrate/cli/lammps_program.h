#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "core/result.h"

namespace pastefit {

/// Whether a program of this name can be started: a path, or a name that is looked for in PATH.
bool is_program(const std::string& name);

/// LAMMPS with the card's laws as styles: the program that the user gave, or one that is built from the shipped sources
/// and kept in `pastefit` of the user's cache (XDG_CACHE_HOME, else ~/.cache) for as long as sources and headers stay
/// the same.
/// Errors: there is no such program; what is needed to build one is missing, all at once; it does not compile.
Result<std::filesystem::path> lammps_program(const std::string& given, const std::atomic<bool>& stop);

}  // namespace pastefit
