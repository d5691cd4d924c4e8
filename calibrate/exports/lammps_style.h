#pragma once

#include <vector>

#include "calibrate/exports/export.h"

namespace pastefit {

/// The sources of pair style pastefit for LAMMPS, looked for in `lammps` of the data folders (PASTEFIT_DATA_DIR, the
/// source's, the installed one). Error: in none of them.
Result<std::vector<ExportFile>> lammps_style();

}  // namespace pastefit
