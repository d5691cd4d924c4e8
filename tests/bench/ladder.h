#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"

namespace pastefit {

/// Readings whose errors are measured, and their names in tables.
inline constexpr std::array kReadings{"step1.height_mm", "step2.height_mm", "step2.plateau_sag_mm", "step2.spread_mm"};
inline constexpr std::array kReadingNames{"h1", "h2", "sag", "spread"};
using ReadingRow = std::array<double, kReadings.size()>;

/// What is varied: one row of a ladder.
struct Setting {
  std::string scene;   ///< one of `kScenes`
  std::string ladder;  ///< one of `kLadders`
  std::string name;
  double radius_m = 0.008;
  std::optional<double> step_share;  ///< fixed step over the smallest that the scene asks for; empty: the engine's own
  int packings = 4;
  bool reference = false;              ///< the rows of the same scene and ladder are compared with it
  RunOptions run = {};                 ///< but for a fixed step, which `step_share` sets
  std::optional<double> raise_s = {};  ///< time in which the plate is turned up; empty: the scene's
};

/// One run of a setting.
struct Run {
  std::uint64_t packing_seed = 0;
  std::optional<ReadingRow> readings;  ///< empty: it failed
  std::string failure;
  double time_step_s = 0, cpu_s = 0, energy_error = 0;
};

/// A setting and all its runs. Means and standard errors are over the runs that did not fail.
struct Row {
  Setting setting;
  std::vector<Run> runs;
};

/// Mean and standard error of a mean (0 for less than two numbers).
struct Mean {
  double value = 0, error = 0;
};

Mean reading_of(const Row& row, std::size_t reading);
Mean cpu_of(const Row& row);  ///< of the runs that did not fail, else of all

/// A row's deviation from its reference, and the noise (standard error) of that difference: a difference within twice
/// the noise is not a difference. With grains of one size packing is compared with packing, otherwise mean with mean.
struct Deviation {
  double value = 0, noise = 0;
  bool is_noise() const { return value < 2 * noise && value > -2 * noise; }
};
Deviation deviation(const Row& row, const Row& reference, std::size_t reading);

/// The reference of a row.
const Row& reference_of(const std::vector<Row>& rows, const Row& row);

/// Dry grains and pastes; "cohesive" is the one between weak and strong.
inline constexpr std::array kScenes{"dry", "weak", "cohesive", "strong"};
inline constexpr std::array kLadders{"step", "shortcuts", "fill", "raise", "grains"};

/// The two-step slump test of EN 12350-5 with grains of radius R. Everything but R is a share of R or a strength, so
/// that every R is the same paste. Requirement: `scene` is one of `kScenes`.
SlumpTest front_scene(const std::string& scene, double radius_m);

/// All rows to be measured; `quick`: few and coarse, to see that the program works.
std::vector<Setting> ladders(bool quick);

/// Filled moulds by radius, seed and the way they are filled.
using Fills = std::map<std::tuple<double, std::uint64_t, Filling>, std::shared_ptr<const Packing>>;

/// Runs a setting with its packings. Fills that are missing are made and kept; their time does not count, unless the
/// setting asks for fills of its own.
Row measure(const Setting& setting, Fills& fills);

}  // namespace pastefit
