#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/laboratory/measurement.h"
#include "calibrate/laboratory/test.h"
#include "core/result.h"

namespace pastefit {

/// Where data come from, carried through to the card.
struct Provenance {
  std::string source;  ///< publication, data set or laboratory
  std::string licence;
  std::string notes;
  bool twin = false;  ///< produced by a simulation with known parameters
};

/// An amount or a property of the mix that a laboratory file names, e.g. water_kg_m3.
struct MixVariable {
  std::string name;  ///< with its unit
  double value = 0;
};

/// A laboratory file: the test as an apparatus with default contact parameters, and what was measured.
struct Lab {
  /// How often the test was made, and in how many of them the heap sheared off, which then has no readings.
  struct Repeats {
    int made = 0, sheared = 0;
    double sheared_share() const { return made > 0 ? static_cast<double>(sheared) / made : 0; }
  };

  std::string title;
  Provenance provenance;
  Test test;
  std::vector<Measurement> measurements;
  std::optional<Measurement> yield_stress;  ///< by a vane or another rheometer [Pa]; compared, never fitted
  Repeats repeats;                          ///< none made: it is not said
  std::vector<MixVariable> mix;             ///< what the material was mixed of, in alphabetical order; not simulated
  std::vector<std::string> stated;          ///< of what is often unstated (`FilePlace`): the places that the file gives
  std::string content;                      ///< what the file and the preset that it names say, as JSON text
  std::string hash;                         ///< of the file's content, with the preset it names (64-bit, hexadecimal)
  std::string note;                         ///< on the preset (`note_on_preset`); empty if there is nothing to say
  std::vector<std::string> notes;  ///< on its numbers, before anything runs: a sentence each, without a full stop
};

/// "1 of 4 heaps of the laboratory sheared off".
std::string sheared_in_words(const Lab::Repeats& repeats);

/// How a free parameter is spaced between its bounds.
enum class Scale { linear, logarithmic };

/// What is known of a parameter before the test: a normal distribution of its value, or of its logarithm on a
/// logarithmic scale, there with standard_deviation/value as its standard deviation; cut off at the bounds.
struct Prior {
  double value = 0, standard_deviation = 0;  ///< in the parameter's unit
};

/// One coordinate of the search, or a fixed value. Names and meaning: `calibrate/study/parameters.h`.
struct Parameter {
  std::string name;
  bool free = false;
  double value = 0;  ///< used when not free
  double lower = 0, upper = 0;
  Scale scale = Scale::linear;
  std::optional<Prior> prior = std::nullopt;  ///< of a free parameter; without one every value is as good as any other
  bool stated = false;                        ///< the study names it; else its value is the default
};

/// What a study asks of one measurement.
struct Target {
  std::string reading;
  double weight = 1;                               ///< in the fit; 0: reported, not fitted
  std::optional<double> tolerance = std::nullopt;  ///< in the reading's unit; none: see `calibrate/study/tolerance.h`
};

/// How to search.
struct SearchOptions {
  std::string strategy = "default";  ///< name of a search strategy or of an NLopt algorithm
  int screening = 8;                 ///< space-filling points
  int budget_simulations = 60;       ///< simulations in all, confirmation included
  int packings = 2;     ///< random packings that an optimiser's candidates share, and those with coarse grains
  int max_pending = 0;  ///< candidates that may be under way when the next one is proposed; above 0 a
                        ///< confirmation asks for all its packings at once
  int confirmation_packings = 4;  ///< fresh packings for the candidate that is reported
  double rejected_share = 0.2;    ///< of heaps that a laboratory would reject, at most; 1: not judged. Not stated: as
                                  ///< many as the laboratory's own, if that is more
  int examination_simulations = 12;  ///< after it, of the same budget: which other candidates fit as well
  std::optional<double> tolerance_mm = std::nullopt;  ///< of each fitted length that has none of its own
  bool coarse_first = false;  ///< look with coarse grains before fine ones (`calibrate/study/tests.h`)
  bool end_early = true;      ///< candidates need not run to their end (`calibrate/evaluate/early_end.h`)
  std::uint64_t seed = 1;
};

/// One test of the material: a laboratory file, and what of it counts.
struct StudyTest {
  std::string name;      ///< unique; empty if the study has one test only
  std::string lab_file;  ///< as the study names it
  Lab lab;
  std::vector<Target> targets;                 ///< one per measurement, in the order of `lab.measurements`
  std::vector<std::string> not_measured = {};  ///< readings that it weighs or allows, but the laboratory did not take
  bool hold_out = false;                       ///< predicted and judged, never fitted
};

/// A study file: the laboratory's tests of one material, its parameters free and fixed, and the search.
/// The parameters are scale-free, so that tests may differ in mould, lift, steps and grains.
struct Study {
  std::string title;
  std::vector<StudyTest> tests;       ///< at least one that is fitted, and that one first
  std::vector<Parameter> parameters;  ///< every known parameter, in the order of `parameters.h`
  SearchOptions search;
  std::string content;  ///< what the study file says, as JSON text
  std::string hash;     ///< of the study file's content
};

/// Changes of what a study and its laboratory files say, made before they are read; each may be left empty.
struct StudyChanges {
  std::function<void(nlohmann::json& study)> of_study;
  std::function<void(nlohmann::json& lab, const std::string& test)> of_lab;  ///< of the test with this name
};

/// Reads a study and the laboratory files it names (paths relative to the study).
/// Errors: every fault of all files at once, each with its place and what would be right.
Result<Study> read_study(const std::filesystem::path& file, const StudyChanges& changes = {});

/// The study that a document stands for, as `read_study` reads it from a file. `file`: the name that places begin with,
/// empty for none; laboratory files are looked for in its folder. In place of the name of a laboratory file the
/// document may hold what such a file says.
Result<Study> study_from_json(nlohmann::json document, const std::filesystem::path& file,
                              const StudyChanges& changes = {});

/// Reads a laboratory file, with the apparatus preset it names; its content is changed before, if there is a `change`.
Result<Lab> read_lab(const std::filesystem::path& file, const std::function<void(nlohmann::json&)>& change = {});

}  // namespace pastefit
