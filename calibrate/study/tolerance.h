#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

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

}  // namespace pastefit
