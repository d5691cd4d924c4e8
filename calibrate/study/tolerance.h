#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/laboratory/test.h"
#include "calibrate/study/study.h"

namespace pastefit {

struct Study;

/// True if the reading is a length in mm.
bool is_length(std::string_view reading);

/// How far off a reading may be for the material to do, in the reading's unit: what the study's "tolerances" say of it;
/// else its "tolerance_mm" for a length, and the default of the test for anything else (`default_tolerance`).
/// Requirements: `test` and `measurement` are indices in `study.tests` and its `lab.measurements`.
double tolerance_of(const Study& study, std::size_t test, std::size_t measurement);

/// In which people are told an error. It has no unit: it is the largest difference of a fitted reading from the
/// laboratory, over its tolerance, and 1 is asked for: one reading that is met does not make up for one that is not.
/// People are told it in mm where all that is fitted are lengths of one tolerance.
struct ErrorUnit {
  std::optional<double> tolerance_mm;  ///< that one tolerance; none: people are told tolerances

  double of(double error) const { return error * tolerance_mm.value_or(1); }
  const char* name() const { return tolerance_mm ? "mm" : "tolerances"; }
  /// "3.94 mm" or "0.788 tolerances"; `pattern`: printf's for the number.
  std::string words(double error, const char* pattern = "%.3g") const;
};

/// The unit for readings with these names and tolerances, all that are fitted.
ErrorUnit error_unit_of(std::span<const std::pair<std::string_view, double>> fitted);
ErrorUnit error_unit_of(const Study& study);

// Studies that are met too easily: by grains so few, or tolerances so wide, that a wrong material meets them as well.

/// Fewest grains that stand for a continuum: 83 of them have met the readings of a wrong material.
inline constexpr double kFewGrains = 500;

/// That the apparatus holds fewer, a sentence without a full stop; empty otherwise, and for tests of one body.
std::string note_on_grain_count(const Test& test);

/// Of every fitted reading whose tolerance is beyond three standard deviations, the laboratory's or the published one,
/// whichever is smaller; a sentence without a full stop, which names the number of grains, too.
std::vector<std::string> notes_on_tolerances(const Study& study);

}  // namespace pastefit
