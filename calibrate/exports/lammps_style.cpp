#include "calibrate/exports/lammps_style.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "calibrate/base/data_folders.h"

namespace pastefit {

namespace fs = std::filesystem;

Result<std::vector<ExportFile>> lammps_style() {
  for (const fs::path& data : data_folders()) {
    const fs::path folder = data / "lammps";
    std::vector<ExportFile> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      files.push_back({entry.path().lexically_relative(folder).generic_string(),
                       std::string(std::istreambuf_iterator<char>(in), {})});
    }
    std::ranges::sort(files, {}, &ExportFile::name);
    if (!files.empty()) return files;
  }
  return Fault{"--to lammps", "the sources of its style were not found",
               "set PASTEFIT_DATA_DIR to the data folder of pastefit, or export with --to lammps-tables"};
}

std::string lammps_style_build(const std::string& program) {
  return "mpicxx -O3 -std=c++17 -I. -isystem /usr/include/lammps *.cpp -o " + program + " -llammps";
}

}  // namespace pastefit
