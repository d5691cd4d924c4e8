#include "calibrate/base/data_folders.h"

#include <dlfcn.h>

#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

namespace pastefit {

namespace fs = std::filesystem;

namespace {

/// `share/pastefit` beside one of the folders that the file of this code lies in: where that is a shared library, as
/// for Python, its program is somebody else's.
std::vector<fs::path> beside_this_code() {
  std::vector<fs::path> found;
  Dl_info code;
  if (dladdr(reinterpret_cast<const void*>(&data_folders), &code) == 0 || !code.dli_fname) return found;
  const fs::path file = code.dli_fname;
  std::error_code error;
  if (file.is_absolute())
    for (fs::path above = file.parent_path(); above.has_relative_path(); above = above.parent_path())
      if (fs::is_directory(above / "share" / "pastefit", error)) found.push_back(above / "share" / "pastefit");
  return found;
}

}  // namespace

std::vector<fs::path> data_folders() {
  std::vector<fs::path> folders;
  if (const char* data = std::getenv("PASTEFIT_DATA_DIR"); data && *data) folders.emplace_back(data);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back((program.parent_path() / ".." / "share" / "pastefit").lexically_normal());
  for (fs::path& folder : beside_this_code()) folders.push_back(std::move(folder));
  for (const std::string_view folder : {PASTEFIT_SOURCE_DATA_DIR, PASTEFIT_INSTALL_DATA_DIR})
    if (!folder.empty()) folders.emplace_back(folder);
  return folders;
}

}  // namespace pastefit
