#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/result.h"
#include "tests/calibrate/folder.h"

namespace pastefit::test {

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
