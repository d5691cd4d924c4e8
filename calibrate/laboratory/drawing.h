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

/// What was seen of one simulation besides its readings.
struct SeenRun {
  std::uint64_t packing = 0;
  Readings readings;
  std::map<std::string, Outline, std::less<>> outlines;  ///< by their names (`outline_at`)
  std::optional<Curve> curve;
};

/// Whose word a part of a drawing is: each has its own look. `run` is one simulation of those behind the means of
/// `simulation`, `rejected` one that a laboratory would repeat.
enum class DrawnBy { laboratory, simulation, apparatus, run, rejected };

using DrawnPoint = std::array<double, 2>;

struct DrawnLine {
  std::string name;
  DrawnBy by = DrawnBy::simulation;
  std::vector<DrawnPoint> points;
  double deviation = 0;  ///< standard deviation of y, in its unit
};

/// Between two curves: x, lower and upper end.
struct DrawnBand {
  std::string name;
  std::vector<std::array<double, 3>> points;
};

/// A length with its two arrows, as in a dimensioned drawing.
struct DrawnLength {
  std::string reading;
  DrawnBy by = DrawnBy::laboratory;
  DrawnPoint from{}, to{};     ///< where its line stands
  DrawnPoint first{}, last{};  ///< what it is the distance of, projected on that line
  double value = 0, deviation = 0;
};

/// A drawing of a test, in the unit that each axis names.
struct Drawing {
  std::string name, x, y;
  bool to_scale = false;  ///< both axes have the same scale
  std::vector<DrawnBand> bands;
  std::vector<DrawnLine> lines;
  std::vector<DrawnLength> lengths;
};

/// What the runs drew, as the mean and, of several, the band from the lowest to the highest.
/// Requirement: curves of one kind, whose points stand at the same places; the longer ones count as far as all go.
Drawing drawing_of_curves(std::string name, std::string x, std::string y, std::span<const SeenRun> runs);

/// Mean of a reading over the runs; nothing if some run, or every one, lacks it.
std::optional<double> mean_reading(std::span<const SeenRun> runs, std::string_view name);

/// The laboratory's measurement of a reading; nothing if there is none.
const Measurement* find_measurement(std::span<const Measurement> measured, std::string_view name);

}  // namespace pastefit
