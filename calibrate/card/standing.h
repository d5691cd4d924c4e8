#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"

namespace pastefit {

/// Why the card does not count as confirmed, as a part of a sentence, e.g. "6 of 8 heaps sheared off, 1 in 5 allowed";
/// empty for a confirmed card.
std::string cause_unconfirmed(const Card& card);

/// "NOT CONFIRMED: " and the cause: the first line of everything that shows or hands on an unconfirmed material; empty
/// for a confirmed card.
std::string unconfirmed_line(const Card& card);

/// A fitted parameter whose value is at a bound of its study.
struct AtBound {
  std::string parameter;
  double value = 0;
  bool upper = false;
};
std::vector<AtBound> parameters_at_bounds(const Card& card);

/// What to do about a card that is not confirmed, a sentence without a full stop; empty for a confirmed one, and one
/// that was interpolated.
std::string what_to_try(const Card& card);

/// Whether every fitted reading is met, but the heaps are ones that a laboratory would reject.
bool only_heaps_refute(const Card& card);

}  // namespace pastefit
