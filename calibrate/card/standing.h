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

/// Evidence from the fitted ones of some tests: means and scatter of their readings, and their heaps. Shape: one heap
/// for each packing, with the largest rejection index of all tests.
Evidence evidence_of(std::span<const CardTest> tests);

/// Judges a material by its tests, simulated on packings that the search has not used.
Confirmation confirmation_by(const Card& card, std::span<const CardTest> tests, std::vector<std::uint64_t> packings);

/// Why the card is not confirmed, as part of a sentence, e.g. "6 of 8 heaps sheared off, 1 in 5 allowed"; empty for a
/// confirmed card.
std::string cause_unconfirmed(const Card& card);

/// "NOT CONFIRMED: " and the cause: first line of all output of an unconfirmed material; empty for a confirmed card.
std::string unconfirmed_line(const Card& card);

struct AtBound {
  std::string parameter;
  double value = 0;
  bool upper = false;
};
std::vector<AtBound> parameters_at_bounds(const Card& card);

/// "friction 0.3 is at its upper bound".
std::string at_bound_in_words(const AtBound& one);

/// Advice for an unconfirmed card, a sentence without a full stop; empty for confirmed and interpolated ones.
std::string what_to_try(const Card& card);

/// True if every fitted reading is met, but too many heaps are rejected.
bool only_heaps_refute(const Card& card);

/// Yield stress of the material as a fluid, by one reading of a test, compared with the measurement.
struct ComparedYieldStress {
  std::string reading;
  std::string_view formula;          ///< its authors and year
  double simulated_pa = 0;           ///< from the simulated reading
  std::optional<double> reading_pa;  ///< from the measured reading, if there is one
  std::optional<double> ratio;       ///< simulated over `CardTest::yield_stress`, if measured
  std::optional<double> deviations;  ///< simulated less measured, in standard deviations of one measurement
};

/// For each simulated reading with a formula (`yield_stresses_of`).
std::vector<ComparedYieldStress> compared_yield_stresses(const CardTest& test);

/// The same by names of readings: {"formula", "simulated", "measured", "ratio", "deviations"}, in Pa.
nlohmann::ordered_json yield_stresses_json(const CardTest& test);

/// The stored form of the card plus `yield_stresses_json` of each test, if any, as "yield_stress_pa". `card_from_json`
/// accepts it and ignores derived values.
nlohmann::ordered_json with_yield_stresses(const Card& card);

/// From the readings of one run: {"formula", "simulated"}.
nlohmann::ordered_json yield_stresses_json(const Test& test, const Readings& readings);

}  // namespace pastefit
