#pragma once

#include <string>
#include <string_view>

namespace pastefit {

/// What starting files have in the place of a source, for a person to replace.
inline constexpr std::string_view kSourceToFillIn = "laboratory, person, date";

/// The source as it was given: empty if it is still what a starting file has there, which is nobody's.
inline std::string stated_source(const std::string& source) {
  return source == kSourceToFillIn ? std::string() : source;
}

}  // namespace pastefit
