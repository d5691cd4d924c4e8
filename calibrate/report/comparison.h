#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "calibrate/card/card.h"

namespace pastefit {

struct CardFile {
  std::string name;
  Card card;
};

/// Table of cards for a terminal of 80 columns: verdicts, differing parameters, and readings. Last column: largest over
/// smallest value of a parameter, largest difference of a reading. A value is marked if another card's interval of that
/// parameter excludes it; these two measurements disagree. Unmarked values may differ because of missing information
/// only. Requirement: at least two cards.
std::string comparison_lines(std::span<const CardFile> cards);

/// The comparison as JSON: `cards`, `parameters` and `readings`; null for missing values.
nlohmann::ordered_json comparison_json(std::span<const CardFile> cards);

}  // namespace pastefit
