#include "calibrate/base/data_folders.h"

#include <cstdlib>
#include <string_view>
#include <system_error>

namespace pastefit {

namespace fs = std::filesystem;

std::vector<fs::path> data_folders() {
  std::vector<fs::path> folders;
  if (const char* data = std::getenv("PASTEFIT_DATA_DIR"); data && *data) folders.emplace_back(data);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back((program.parent_path() / ".." / "share" / "pastefit").lexically_normal());
  for (const std::string_view folder : {PASTEFIT_SOURCE_DATA_DIR, PASTEFIT_INSTALL_DATA_DIR})
    if (!folder.empty()) folders.emplace_back(folder);
  return folders;
}

}  // namespace pastefit
