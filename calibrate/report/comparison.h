#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "calibrate/card/card.h"

namespace pastefit {

/// A card and the file that it was read from.
struct CardFile {
  std::string name;
  Card card;
};

/// Cards beside each other, for a terminal of 80 columns: their verdicts, the parameters that differ, and the readings.
/// The last column is the largest value over the smallest of a parameter, and the largest difference of a reading. A
/// value is marked where the interval that another card has of that parameter excludes it: those two measurements
/// disagree on it. Values without a mark may differ for want of information alone. Requirement: at least two cards.
std::string comparison_lines(std::span<const CardFile> cards);

/// The same as JSON: `cards`, `parameters` and `readings`; null stands for what a card does not have.
nlohmann::ordered_json comparison_json(std::span<const CardFile> cards);

}  // namespace pastefit
