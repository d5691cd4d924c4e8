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

/// True for lengths in mm.
bool is_length(std::string_view reading);

/// Largest accepted difference of a reading, in its unit: from "tolerances" of the study; else "tolerance_mm" for
/// lengths, and the test's default (`default_tolerance`) for other readings. Requirements: `test` and `measurement` are
/// indices in `study.tests` and its `lab.measurements`.
double tolerance_of(const Study& study, std::size_t test, std::size_t measurement);

/// Unit in which an error is displayed. The error is dimensionless: the largest difference of a fitted reading from the
/// measurement, over its tolerance; at most 1 is required of the largest, so a good reading does not compensate a poor
/// one. It is displayed in mm if all fitted readings are lengths with the same tolerance.
struct ErrorUnit {
  std::optional<double> tolerance_mm;  ///< the common tolerance; none: unit "tolerances"

  double of(double error) const { return error * tolerance_mm.value_or(1); }
  const char* name() const { return tolerance_mm ? "mm" : "tolerances"; }
  /// "3.94 mm" or "0.788 tolerances"; `pattern`: a printf format for the number.
  std::string words(double error, const char* pattern = "%.3g") const;
};

/// Unit for the names and tolerances of all fitted readings.
ErrorUnit error_unit_of(std::span<const std::pair<std::string_view, double>> fitted);
ErrorUnit error_unit_of(const Study& study);

// Studies that a wrong material can satisfy, because of too few grains or too wide tolerances.

/// Fewest grains of a continuum: with 83, a wrong material has matched the readings.
inline constexpr double kFewGrains = 500;

/// Note that the apparatus holds fewer grains, a sentence without a full stop; empty otherwise, and for tests of one
/// body.
std::string note_on_grain_count(const Test& test);

/// Notes on fitted readings whose tolerance exceeds three standard deviations, the measured or the published one,
/// whichever is smaller. Each is a sentence without a full stop, and includes the number of grains.
std::vector<std::string> notes_on_tolerances(const Study& study);

}  // namespace pastefit
