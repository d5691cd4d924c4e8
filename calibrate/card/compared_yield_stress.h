#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/card/card.h"

namespace pastefit {

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
