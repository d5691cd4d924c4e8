#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/laboratory/measurement.h"
#include "calibrate/laboratory/test.h"
#include "core/result.h"

namespace pastefit {

/// Source of the data, copied to the card.
struct Provenance {
  std::string source;  ///< publication, data set or laboratory
  std::string licence;
  std::string notes;
  bool twin = false;  ///< produced by a simulation with known parameters
};

/// Amount or property of the mix in a laboratory file, e.g. water_kg_m3.
struct MixVariable {
  std::string name;  ///< with its unit
  double value = 0;
};

/// Laboratory file: the test, as an apparatus with default contact parameters, and its measurements.
struct Lab {
  /// Number of tests made, and of those whose heap sheared off; those have no readings.
  struct Repeats {
    int made = 0, sheared = 0;
    double sheared_share() const { return made > 0 ? static_cast<double>(sheared) / made : 0; }
  };

  std::string title;
  Provenance provenance;
  Test test;
  std::vector<Measurement> measurements;
  std::optional<Measurement> yield_stress;  ///< from a vane or another rheometer [Pa]; compared, never fitted
  Repeats repeats;                          ///< none made: not stated
  std::vector<MixVariable> mix;             ///< composition of the material, in alphabetical order; not simulated
  std::vector<std::string> stated;          ///< often unstated places (`FilePlace`) that the file gives
  std::string content;                      ///< of the file and its preset, as JSON text
  std::string hash;                         ///< of the file with its preset (64-bit, hexadecimal)
  std::string note;                         ///< on the preset, if it is not the shipped one; may be empty
  std::vector<std::string> notes;  ///< on its numbers, before any simulation: one sentence each, without a full stop
};

/// "1 of 4 heaps of the laboratory sheared off".
std::string sheared_in_words(const Lab::Repeats& repeats);

/// Spacing of a free parameter between its bounds.
enum class Scale { linear, logarithmic };

/// Information on a parameter before the test: a normal distribution of its value. On a logarithmic scale, of its
/// logarithm, with standard deviation standard_deviation/value. Truncated at the bounds.
struct Prior {
  double value = 0, standard_deviation = 0;  ///< in the parameter's unit
};

/// Coordinate of the search, or fixed value. Names and meanings: `calibrate/study/parameters.h`.
struct Parameter {
  std::string name;
  bool free = false;
  double value = 0;  ///< if not free
  double lower = 0, upper = 0;
  Scale scale = Scale::linear;
  std::optional<Prior> prior = std::nullopt;  ///< of a free parameter; none: uniform between the bounds
  bool stated = false;                        ///< given in the study; otherwise `value` is the default
};

/// Every known parameter, fixed at its default value.
std::vector<Parameter> default_parameters();

struct Target {
  std::string reading;
  double weight = 1;                               ///< in the fit; 0: reported, not fitted
  std::optional<double> tolerance = std::nullopt;  ///< in the reading's unit; none: see `calibrate/study/tests.h`
};

struct SearchOptions {
  std::string strategy = "default";  ///< name of a search strategy or of an NLopt algorithm
  int screening = 8;                 ///< space-filling points
  int budget_simulations = 60;       ///< in total, confirmation included
  int packings = 2;     ///< random packings shared by an optimiser's candidates, and those with coarse grains
  int max_pending = 0;  ///< most running candidates when another is proposed; above 0: confirmation is one batch
  int confirmation_packings = 4;     ///< new packings for the reported candidate
  double rejected_share = 0.2;       ///< of heaps, at most; 1: not judged; default: the measured share if larger
  int examination_simulations = 12;  ///< of the same budget, after the search: which other candidates fit as well
  std::optional<double> tolerance_mm = std::nullopt;  ///< of fitted lengths without a tolerance of their own
  bool coarse_first = false;                          ///< search with coarse grains first (`calibrate/study/tests.h`)
  bool end_early = true;  ///< candidates may be stopped early (`calibrate/evaluate/simulation.h`)
  std::uint64_t seed = 1;
};

/// Test of the material: a laboratory file with weights and tolerances.
struct StudyTest {
  std::string name;      ///< unique; empty if the study has only one test
  std::string lab_file;  ///< name in the study
  Lab lab;
  std::vector<Target> targets;                 ///< one per measurement, in the order of `lab.measurements`
  std::vector<std::string> not_measured = {};  ///< readings with a weight or tolerance, but without a measurement
  bool hold_out = false;                       ///< predicted and judged, never fitted
};

/// Study file: tests of one material, free and fixed parameters, and search options. The parameters are scale-free, so
/// tests may differ in mould, lift, steps and grains.
struct Study {
  std::string title;
  std::vector<StudyTest> tests;       ///< at least one fitted test; fitted tests first
  std::vector<Parameter> parameters;  ///< every known parameter, in the order of `parameters.h`
  SearchOptions search;
  std::string content;                     ///< of the study file, as JSON text
  std::string hash;                        ///< of `content`
  std::vector<std::string> settings = {};  ///< "path=value", by which the content differs from its file
};

/// Changes of the contents of a study and its laboratory files before they are read; each may be empty.
struct StudyChanges {
  std::function<void(nlohmann::json& study)> of_study;
  /// `test`: as far as it is read before its laboratory file, its name and whether it is held out.
  std::function<void(nlohmann::json& lab, const StudyTest& test)> of_lab;
};

/// Reads a study and its laboratory files (paths relative to the study). Errors: every fault of all files, with place
/// and remedy.
Result<Study> read_study(const std::filesystem::path& file, const StudyChanges& changes = {});

/// Parses a study like `read_study`. `file`: prefix of the places, may be empty; laboratory files are looked for in its
/// folder. The document may contain a laboratory file's content in place of its name.
Result<Study> study_from_json(nlohmann::json document, const std::filesystem::path& file,
                              const StudyChanges& changes = {});

/// Reads a laboratory file with its apparatus preset, after applying `change` to its content, if given.
Result<Lab> read_lab(const std::filesystem::path& file, const std::function<void(nlohmann::json&)>& change = {});

/// Change of a file's content before it is read, so that all checks of its reader apply.
struct Setting {
  std::string path;  ///< of keys, as in the file: "search.seed", "tests[0].lab"
  nlohmann::json value;
};

/// Parses texts "path=value", as given to --set. A value that is not JSON is a text. Errors: no path; control
/// characters, or bytes that are not UTF-8.
std::vector<Setting> read_settings(const std::vector<std::string>& texts, Faults& faults);

/// Sets the value at its path. New keys are added: the reader of the file reports unknown ones. Error: the path does
/// not lead to a place in the file.
void apply(const Setting& setting, nlohmann::json& document, Faults& faults);

/// Reads a study with changes of its file's content ("path=value"), which `Study::settings` keeps.
/// `parameters.NAME.lower` and `parameters.NAME.upper` are the bounds of a free parameter. A changed study has another
/// hash than its file. Errors: those of `read_settings`, `apply` and `read_study`.
Result<Study> read_study_with(const std::filesystem::path& file, const std::vector<std::string>& texts);

}  // namespace pastefit
