#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// What one reading of a test says of its material as a fluid with a yield stress, beside what the laboratory measured.
struct ComparedYieldStress {
  std::string reading;
  std::string_view formula;          ///< its authors and year
  double simulated_pa = 0;           ///< by the simulated reading
  std::optional<double> reading_pa;  ///< by the laboratory's, if it was taken
  std::optional<double> ratio;       ///< of the simulated to `CardTest::yield_stress`, if that was measured
  std::optional<double> deviations;  ///< by which it is above that, in standard deviations of one measurement
};

/// Of each simulated reading for which there is a formula (`yield_stresses_of`).
std::vector<ComparedYieldStress> compared_yield_stresses(const CardTest& test);

/// The same by the names of the readings: {"formula", "simulated", "measured", "ratio", "deviations"}, in Pa.
nlohmann::ordered_json yield_stresses_json(const CardTest& test);

/// The card as it is stored, with `yield_stresses_json` of each test, where there are any, as its "yield_stress_pa".
/// `card_from_json` reads that, too, without what is derived.
nlohmann::ordered_json with_yield_stresses(const Card& card);

/// Of the readings of one run: {"formula", "simulated"}.
nlohmann::ordered_json yield_stresses_json(const Test& test, const Readings& readings);

}  // namespace pastefit
