#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// A measurement that a search answers for: one residual.
struct StudyReading {
  std::size_t test = 0;  ///< of `Study::tests`
  std::string name;      ///< unique in the study
  Measurement measurement;
  double weight = 1;     ///< 0: reported, not fitted
  double tolerance = 1;  ///< in the unit of the measurement (`calibrate/study/tolerance.h`)
};

/// The name of a test's reading beside those of other tests: "slow/step1.height_mm"; without the test's name if it has
/// none.
std::string reading_name(const StudyTest& test, std::string_view reading);

/// Every measurement of the tests that are fitted, in their order.
std::vector<StudyReading> readings_of(const Study& study);

/// The tests that are fitted, or those held out, as indices.
std::vector<std::size_t> tests_of(const Study& study, bool hold_out);

/// The fault of a name that no test has.
Fault no_such_test(const std::string& name, const std::vector<std::string>& names);

/// How the laboratory files of a study are read.
struct LabReading {
  std::filesystem::path folder;  ///< of the study
  std::function<void(nlohmann::json& lab, const std::string& test)> change;
  Faults& faults;  ///< of these files, their places beginning with the file
};

/// Reads "lab", "weights" and "tolerances" of a study of one test, or "tests", a list of {"name", "lab", "weights",
/// "tolerances", "hold_out"}.
/// The tests that are held out are moved behind the others: the first one, whose grains a card states its material for,
/// is fitted.
std::vector<StudyTest> read_tests(ObjectReader& document, const nlohmann::json& study, const LabReading& labs);

/// The place among these tests, of a study or of a card, of the one with this name.
/// Error: none has it; the fault says which there are.
template <class Tests>
Result<std::size_t> place_of_test(const Tests& tests, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& test : tests) {
    if (test.name == name) return names.size();
    names.push_back(test.name);
  }
  return no_such_test(name, names);
}

/// All that decides the way of a study's search, as JSON text: the study without its title and budget, and the content
/// of its laboratory files.
std::string inputs_of(const Study& study);

/// Radius of the coarse grains over that of the study. A simulation costs about the fourth power of it: a fifth.
inline constexpr double coarse_radius_ratio = 1.5;

/// The study with grains `coarse_radius_ratio` times as large; its parameters are free of scale. With fewer than some
/// hundred grains in the mould it may not be fit to run: see `validate`.
Study with_coarse_grains(Study study);

}  // namespace pastefit
