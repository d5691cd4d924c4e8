#pragma once

#include <string>
#include <vector>

#include "core/random.h"

namespace pastefit::fuzz {

/// The strings of a JSON text, quotation marks included, each once and sorted: the words that its reader knows.
std::vector<std::string> describe(const std::vector<std::string>& texts);

/// `text` with one to six faults drawn from `random`, as a broken disk, a slip of the hand or somebody who means harm
/// would make them: a number or a word that becomes another (also none at all, or one beyond every bound), a part that
/// is missing, stands twice or comes from another of the `texts`, a bit that is flipped, an end that is cut off.
std::string mutated(std::string text, const std::vector<std::string>& texts, const std::vector<std::string>& words,
                    const RandomStream& random);

}  // namespace pastefit::fuzz
