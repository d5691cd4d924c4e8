#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/result.h"

namespace pastefit::test {

/// A folder that is gone after the test.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pastefit-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::string with(std::string text, std::string_view part, std::string_view replacement) {
  const std::size_t at = text.find(part);
  if (at == std::string::npos) throw std::invalid_argument("the text has no such part: " + std::string(part));
  return text.replace(at, part.size(), replacement);
}

/// The fault at this place (which may stand behind a file's name), or a fault with nothing in it.
inline Fault at(const Faults& faults, std::string_view place) {
  const auto found = std::ranges::find_if(faults, [&](const Fault& fault) { return fault.where.ends_with(place); });
  return found == faults.end() ? Fault{} : *found;
}

inline bool says(const Fault& fault, std::string_view part) {
  return (fault.what + "; " + fault.remedy).find(part) != std::string::npos;
}

}  // namespace pastefit::test
