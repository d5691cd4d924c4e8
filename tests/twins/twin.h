#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// How twin laboratories are made. The recipe and a number make a twin, the same wherever it is made.
struct TwinRecipe {
  std::uint64_t seed = 1;     ///< of the truths, the packings and the ruler
  double truth_radius_m = 0;  ///< mean one of the twin's grains; 0: those of the study
  int repeats = 5;            ///< of the test, each on a packing of its own
  double ruler_mm = 1;        ///< standard deviation of reading a height; five times that for a spread
};

/// A laboratory whose material is known.
struct Twin {
  int number = 0;
  UnitPoint truth;                    ///< in the unit cube of the study's free parameters
  std::vector<double> values;         ///< the same, of the free parameters
  Study study;                        ///< with the twin's measurements in place of the laboratory's
  std::vector<double> true_readings;  ///< of the study's measurements, before the ruler
};

/// What became of one free parameter.
struct TwinParameter {
  std::string name;
  double truth = 0, recommended = 0, lower = 0, upper = 0;
  bool lower_known = false, upper_known = false;
};

/// How the calibration of a twin went.
struct TwinResult {
  int number = 0;
  std::string status;  ///< of the calibration, or "no twin" with the reason if the truth itself fails
  int simulations = 0;
  double wall_s = 0;
  std::vector<double> misses;  ///< of the fitted readings, mean on fresh packings to the laboratory's, in standard
                               ///< errors of both
  int determined = 0;          ///< combinations
  std::string lead;            ///< parameter that leads the best determined one
  double lead_error = -1;      ///< of that, as a change of its lead alone; share of it, or of its range
  bool lead_held = false;      ///< it lies in the 95 % interval that the calibration states, the others held

  double worst_miss() const { return misses.empty() ? 0 : *std::ranges::max_element(misses); }
  std::vector<TwinParameter> parameters;
};

/// The twin's laboratory: simulations of the truth, read with a ruler. Truths are Sobol points of the study's box.
/// Errors: the truth fails on one of its packings.
Result<Twin> make_twin(const Study& study, const TwinRecipe& recipe, int number, const PoolOptions& options);

/// Calibrates the twin as `pastefit calibrate` does, with its evaluations in `store_file`, and compares with the truth.
TwinResult calibrate_twin(const Twin& twin, const std::filesystem::path& store_file, const PoolOptions& options);

}  // namespace pastefit
