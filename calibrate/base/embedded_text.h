#pragma once

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pastefit {

/// Source text embedded in the program (calibrate/embedded_texts.cmake), by its path in calibrate:
/// "laboratory/templates/lab.json". Nothing if there is none.
std::optional<std::string_view> embedded_text(std::string_view file);

/// The embedded text with @name@ replaced by values. The line break after a value is dropped if the value ends with
/// one, or is empty and alone on its line. Throws std::logic_error for an unknown file, std::out_of_range for an
/// unknown name.
inline std::string filled_in(std::string_view file, const std::map<std::string_view, std::string>& values) {
  const auto found = embedded_text(file);
  if (!found) throw std::logic_error("no text is embedded as " + std::string(file));
  std::string_view rest = *found;
  std::string out;
  for (std::size_t begin = rest.find('@'); begin != rest.npos; begin = rest.find('@')) {
    const std::size_t end = rest.find('@', begin + 1);
    out.append(rest.substr(0, begin)).append(values.at(rest.substr(begin + 1, end - begin - 1)));
    rest.remove_prefix(end + 1);
    if (rest.starts_with('\n') && (out.empty() || out.back() == '\n')) rest.remove_prefix(1);
  }
  return out.append(rest);
}

}  // namespace pastefit
