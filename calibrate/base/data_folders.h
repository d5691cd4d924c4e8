#pragma once

#include <filesystem>
#include <vector>

namespace pastefit {

/// Where the program's data may be (apparatus, cases, the style for LAMMPS), the first that counts first: the folder
/// that the environment variable PASTEFIT_DATA_DIR names; `share/pastefit` beside the program's own folder, so that an
/// installed tree may be moved, or beside a folder above that of the shared library this is in; the sources' (not in
/// packages); the folder that was configured. None of them need be there.
std::vector<std::filesystem::path> data_folders();

}  // namespace pastefit
