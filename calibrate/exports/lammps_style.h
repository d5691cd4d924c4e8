#pragma once

#include <string>
#include <vector>

#include "calibrate/exports/export.h"

namespace pastefit {

/// The sources of pair style pastefit for LAMMPS, looked for in `lammps` of the data folders (PASTEFIT_DATA_DIR, the
/// source's, the installed one). Error: in none of them.
Result<std::vector<ExportFile>> lammps_style();

/// The command of a shell, in the folder of these sources, that builds LAMMPS with the style as this file, where
/// Debian's liblammps-dev is installed.
std::string lammps_style_build(const std::string& program);

}  // namespace pastefit
