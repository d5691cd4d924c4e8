#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/report/views.h"

namespace pastefit {

inline const std::string kViewsFile = "views.json";

/// Keeps what is shown of a card's tests on these packings, so that its page needs no simulation:
///     {"format", "checksum", "program", "tests": [{"simulations": [...], "film": {"index", "grains"},
///      "runs": [{"packing", "readings", "outlines", "curve"}], "failures": [...]}]};
/// simulations: the name (`evaluation_key`) of each packing's, also of those that failed; checksum: of all the rest.
/// Requirement: a view for each test, and none lacks anything.
/// Errors: the file cannot be written.
Faults write_views(const std::filesystem::path& file, const Card& card, std::span<const std::uint64_t> packings,
                   const std::vector<TestView>& views);

/// The views of the card's tests on these packings, as they were kept, whichever program simulated them.
/// Errors: there is no such file, it is larger than 16 MB, damaged, or of another material, other tests or other
/// packings.
Result<std::vector<TestView>> read_views(const std::filesystem::path& file, const Card& card,
                                         std::span<const std::uint64_t> packings);

}  // namespace pastefit
