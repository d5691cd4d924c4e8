#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Fitted or reported measurement: one residual.
struct StudyReading {
  std::size_t test = 0;  ///< of `Study::tests`
  std::string name;      ///< unique in the study
  Measurement measurement;
  double weight = 1;     ///< 0: reported, not fitted
  double tolerance = 1;  ///< in the reading's unit (`tolerance_of`)
};

/// Name of a reading in a study or card with several tests, "slow/step1.height_mm"; without prefix if the test has no
/// name.
std::string reading_name(const auto& test, std::string_view reading) {
  return (test.name.empty() ? "" : test.name + "/") + std::string(reading);
}

/// Measurements of the fitted tests, in order.
std::vector<StudyReading> readings_of(const Study& study);

/// Indices of the fitted, or of the held-out tests.
std::vector<std::size_t> tests_of(const Study& study, bool hold_out);

/// How to read the laboratory files of a study.
struct LabReading {
  std::filesystem::path folder;  ///< of the study
  std::function<void(nlohmann::json& lab, const StudyTest& test)> change;
  Faults& faults;  ///< of these files; their places begin with the file name
};

/// Reads "lab", "weights" and "tolerances" of a study of one test, or "tests", a list of {"name", "lab", "weights",
/// "tolerances", "hold_out"}. Held-out tests are moved to the end: the first test, whose grains the card's material
/// refers to, is fitted.
std::vector<StudyTest> read_tests(ObjectReader& document, const LabReading& labs);

/// Index of the test with this name, in a study or card. Error: no such test; the fault lists the names.
Result<std::size_t> place_of_test(const auto& tests, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& test : tests) {
    if (test.name == name) return names.size();
    names.push_back(test.name);
  }
  const std::string known = listed(names);
  return Fault{"--test " + printable(name), "there is no such test",
               known.empty() ? "leave it out: the only test has no name" : "one of: " + known};
}

/// Everything that affects the search, as JSON text: the study without title and budget, and its laboratory files.
std::string inputs_of(const Study& study);

/// Radius of the coarse grains over that of the study. The cost falls with about its fourth power, to a fifth.
inline constexpr double coarse_radius_ratio = 1.5;

/// The study with grains `coarse_radius_ratio` times as large; its parameters are scale-free. With fewer than some
/// hundred grains in the mould it may not be runnable: see `validate`.
Study with_coarse_grains(Study study);

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
