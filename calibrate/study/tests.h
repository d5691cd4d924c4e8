#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
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
  double tolerance = 1;  ///< in the reading's unit (`calibrate/study/tolerance.h`)
};

/// Name of a reading in a study with several tests, "slow/step1.height_mm"; without prefix if the test has no name.
std::string reading_name(const StudyTest& test, std::string_view reading);

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

}  // namespace pastefit
