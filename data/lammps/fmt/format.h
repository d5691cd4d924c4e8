#pragma once

#include <string>

// Debian's liblammps-dev ships headers that include fmt/format.h, but not that file. These names are all that its
// declarations need; nothing here is ever called.
namespace fmt {

struct format_args {};

using string_view = const std::string&;

template <class... Args, class Format>
format_args make_args_checked(const Format&, const Args&...) {
  return {};
}

}  // namespace fmt
