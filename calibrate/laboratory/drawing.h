#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/laboratory/measurement.h"
#include "core/observe/outline.h"
#include "core/observe/readings.h"
#include "core/step/run.h"

namespace pastefit {

/// Data of one simulation for drawings and tables.
struct SeenRun {
  std::uint64_t packing = 0;
  Readings readings;
  std::map<std::string, Outline, std::less<>> outlines;  ///< by name (`outline_at`)
  std::optional<Curve> curve;
};

/// Source of a part of a drawing, which determines its style. `run`: a simulation that enters the means of
/// `simulation`; `rejected`: a simulation that the standards reject.
enum class DrawnBy { laboratory, simulation, apparatus, run, rejected };

using DrawnPoint = std::array<double, 2>;

struct DrawnLine {
  std::string name;
  DrawnBy by = DrawnBy::simulation;
  std::vector<DrawnPoint> points;
  double deviation = 0;                                 ///< standard deviation of y, in its unit
  std::optional<std::uint64_t> packing = std::nullopt;  ///< of the line of one run
};

/// Band between two curves: x, lower and upper end.
struct DrawnBand {
  std::string name;
  std::vector<std::array<double, 3>> points;
};

struct DrawnLength {
  std::string reading;
  DrawnBy by = DrawnBy::laboratory;
  DrawnPoint from{}, to{};     ///< ends of the dimension line
  DrawnPoint first{}, last{};  ///< measured points, projected on that line
  double value = 0, deviation = 0;
};

/// Drawing of a test; the axes name their units.
struct Drawing {
  std::string name, x, y;
  bool to_scale = false;  ///< both axes have the same scale
  std::vector<DrawnBand> bands;
  std::vector<DrawnLine> lines;
  std::vector<DrawnLength> lengths;
};

/// Mean of the curves of the runs, with the band from lowest to highest if there are several. Requirement: curves of
/// one kind with points at the same abscissas; the shortest limits the length.
Drawing drawing_of_curves(std::string name, std::string x, std::string y, std::span<const SeenRun> runs);

/// Mean of a reading over the runs; nothing without runs, or if any run lacks it.
std::optional<double> mean_reading(std::span<const SeenRun> runs, std::string_view name);

/// Measurement of a reading; null if there is none.
const Measurement* find_measurement(std::span<const Measurement> measured, std::string_view name);

}  // namespace pastefit
