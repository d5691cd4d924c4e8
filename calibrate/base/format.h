#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace pastefit {

/// A line by printf's rules, cut after 511 characters. Numbers and C strings only.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(), pattern, values...);
  return line.data();
}

}  // namespace pastefit
