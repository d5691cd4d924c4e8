#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pastefit {

/// The names of all starting files.
std::vector<std::string_view> template_names();

/// A commented starting file, fit to be read as it is (a study names its laboratory file "lab.json", beside it).
/// Nothing if there is none of that name.
std::optional<std::string> template_text(std::string_view name);

}  // namespace pastefit
