#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/rigs/slump_table.h"

namespace pastefit {

/// What a laboratory read off one test: mean and standard deviation of its repeats.
struct Measurement {
  std::string observable;         ///< key of the reading, e.g. "step1.height_mm"
  double value = 0;               ///< mean, in the unit of the key
  double standard_deviation = 0;  ///< of one reading, in the unit of the key
  int repeats = 1;
};

/// Where data come from, carried through to the card.
struct Provenance {
  std::string source;  ///< publication, data set or laboratory
  std::string licence;
  std::string notes;
  bool twin = false;  ///< produced by a simulation with known parameters
};

/// A laboratory file: the test as a rig with default contact parameters, and what was measured.
struct Lab {
  std::string title;
  Provenance provenance;
  SlumpTable test;
  std::vector<Measurement> measurements;
  std::string hash;  ///< of the file's content, with the preset it names (64-bit, hexadecimal)
};

/// How a free parameter is spaced between its bounds.
enum class Scale { linear, logarithmic };

/// One coordinate of the search, or a fixed value. Names and meaning: `calibrate/study/parameters.h`.
struct Parameter {
  std::string name;
  bool free = false;
  double value = 0;  ///< used when not free
  double lower = 0, upper = 0;
  Scale scale = Scale::linear;
};

/// Weight of one measurement in the fit; 0: reported, not fitted.
struct Weight {
  std::string observable;
  double weight = 1;
};

/// How to search.
struct SearchOptions {
  std::string strategy = "default";  ///< name of a search strategy or of an NLopt algorithm
  int screening = 12;                ///< space-filling points
  int budget_simulations = 60;       ///< simulations in all, confirmation included
  int packings = 2;                  ///< common random packings per candidate
  int confirmation_packings = 4;     ///< fresh packings for the candidate that is reported
  int examination_simulations = 12;  ///< after it, of the same budget: which other candidates fit as well
  double tolerance_mm = 5;           ///< a confirmed misfit below it ends the search
  bool coarse_first = false;         ///< look with coarse grains before fine ones (`calibrate/search/coarse_rung.h`)
  std::uint64_t seed = 1;
};

/// A study file: one laboratory file, its parameters free and fixed, weights, and the search.
struct Study {
  std::string title;
  Lab lab;
  std::vector<Parameter> parameters;  ///< every known parameter, in the order of `parameters.h`
  std::vector<Weight> weights;        ///< one per measurement, in the order of `lab.measurements`
  SearchOptions search;
  std::string hash;  ///< of the study file's content
};

/// Reads a study and the laboratory file it names (path relative to the study).
/// Errors: every fault of both files at once, each with its place and what would be right.
Result<Study> read_study(const std::filesystem::path& file);

/// Reads a laboratory file, with the rig preset it names.
Result<Lab> read_lab(const std::filesystem::path& file);

}  // namespace pastefit
