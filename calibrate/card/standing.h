#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/judge/verdict.h"

namespace pastefit {

/// What the runs of some tests that are fitted say of the material: their readings by mean and scatter, and their
/// heaps. Shape: one heap for each packing of the first of them; the one that is nearest to being rejected of its
/// tests.
Evidence evidence_of(std::span<const CardTest> tests);

/// What share of the heaps of these tests may be rejected, by the card's confirmation; in cards that did not keep it
/// the default of studies; 1: a laboratory rejects none of this kind.
double rejected_share_of(const Card& card, std::span<const CardTest> tests);

/// Judges a material by its tests, simulated on these packings, which the search had not seen.
Confirmation confirmation_by(const Card& card, std::span<const CardTest> tests, std::vector<std::uint64_t> packings);

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
