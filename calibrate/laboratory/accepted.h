#pragma once

#include <cstddef>
#include <vector>

namespace pastefit {

/// Of runs some of which a laboratory would reject: those that it would accept, as indices; all of them, if it would
/// reject every one, so that a reading is never without a number. Readings are means over these: a laboratory repeats
/// the others and does not report them.
inline std::vector<std::size_t> accepted(const std::vector<bool>& rejected) {
  std::vector<std::size_t> all, good;
  for (std::size_t i = 0; i < rejected.size(); ++i) {
    all.push_back(i);
    if (!rejected[i]) good.push_back(i);
  }
  return good.empty() ? all : good;
}

}  // namespace pastefit
