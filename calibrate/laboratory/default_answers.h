#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/measurement.h"
#include "calibrate/laboratory/specimen_json.h"
#include "core/apparatus/reading_kind.h"
#include "core/apparatus/specimen.h"
#include "core/observe/outline.h"
#include "core/observe/readings.h"
#include "core/step/run.h"

namespace pastefit {

/// Size in a test, in the unit of its key, with the usual range. The program asks about values far outside.
struct Experience {
  std::string_view place;
  double value = 0, smallest = 0, largest = 0;
};

/// Yield stress of a fluid that would give this reading, by a formula from the literature.
struct YieldStress {
  std::string reading;
  std::string_view formula;  ///< its authors and year
  double pa = 0;
};

/// Reading that a fluid with a given yield stress would give, by a formula from the literature.
struct PredictedReading {
  std::string_view key;  ///< in laboratory files
  std::string_view formula;
  double value = 0;               ///< in the unit of the key
  double standard_deviation = 0;  ///< error of the formula, in the unit of the key
};

// Defaults for kinds of tests without poured grains or random packing. Other kinds overload them for their own type
// (calibrate/laboratory/slump.h).

/// Test with default values and all optional parts.
template <class Kind>
Kind default_test(const Kind&) {
  return {};
}

inline std::shared_ptr<const Packing> prepare(const Specimen&, const RunOptions&) {
  return nullptr;
}

inline std::string preparation_key(const Specimen&) {
  return {};
}

/// Simulated time in which the apparatus moves [s], without filling and waiting for rest.
inline double moved_time_s(const Specimen&) {
  return 0;
}

/// Reads a measured outline; called for readings with `ReadingKind::from_outline`.
inline void read_outline(ObjectReader&, const ReadingKind&, Specimen&) {}

/// Enables a measured reading of this kind; called for readings with `ReadingKind::on_request`.
inline void ask_for(Specimen&, const ReadingKind&) {}

/// Surfaces with parameters in a study. Default: none, since tools are of steel, with properties given in the
/// apparatus, or of the grains' material.
inline std::vector<Surface> surfaces_of(Specimen&) {
  return {};
}

/// Density of a grain [kg/m^3] from the mean readings of some runs; nothing if unknown. Default: the bulk density in
/// the laboratory file is that of a grain.
inline std::optional<double> grain_density_of(const Specimen& test, const Readings&) {
  return test.bulk_density_kg_m3;
}

/// Reason why the grains must have the size of the real ones; empty if the simulation may choose it.
inline std::string_view why_of_that_size(const Specimen&) {
  return {};
}

/// Outline of the heap in this snapshot, from the side; nothing if there is none, e.g. during filling.
inline std::optional<Outline> heap_at(const Specimen&, const Snapshot&) {
  return std::nullopt;
}

/// Drawings of the test: results of runs of one material, over the measurements.
inline std::vector<Drawing> drawings_of(const Specimen&, std::span<const SeenRun>, std::span<const Measurement>) {
  return {};
}

/// Narrowest opening [m] that the grains pass; nothing if there is none.
inline std::optional<double> narrowest_opening_m(const Specimen&) {
  return std::nullopt;
}

/// Default tolerance of a reading: one standard deviation of the measurement.
inline double default_tolerance(const Specimen&, const Measurement& measured) {
  return measured.standard_deviation;
}

/// Message on free parameters that the fitted readings do not identify, with advice; may be empty.
inline std::string unseen_by(const Specimen&, std::span<const std::string_view>, std::span<const std::string_view>) {
  return {};
}

/// Smallest plausible density: powders are rarely below 250 kg/m^3, while every paste is if given in lb/ft3 or kg/l.
inline std::vector<Experience> experience_of(const Specimen& test) {
  return {{"material.bulk_density_kg_m3", test.bulk_density_kg_m3, 250, 10000}};
}

/// Notes and faults of implausible or impossible combinations of measurements.
inline ReadingCheck check_readings(const Specimen&, std::span<const Measurement>) {
  return {};
}

/// Yield stresses that follow from the readings.
inline std::vector<YieldStress> yield_stresses_of(const Specimen&, const Readings&) {
  return {};
}

/// Readings of a fluid with this yield stress, in the order of the test; an empty list where no formula is valid,
/// nothing for kinds of tests without such formulas.
inline std::optional<std::vector<PredictedReading>> readings_of_fluid(const Specimen&, double) {
  return std::nullopt;
}

/// Range in which a parameter probably is, in its unit.
struct LikelyRange {
  double lowest = 0, highest = 0;
};

/// Probable range of the strength [Pa] (`strength_pa`) for these readings; nothing if unknown.
inline std::optional<LikelyRange> likely_strength_pa(const Specimen&, const Readings&) {
  return std::nullopt;
}

/// Rejection index: above 1, the standards require the test to be repeated. NaN if not read; nothing for kinds of tests
/// without rejection.
inline std::optional<double> rejection_index(const Specimen&, const Readings&) {
  return std::nullopt;
}

/// End of a sentence on rejected runs, after "6 of 8".
inline std::string_view rejected_runs(const Specimen&) {
  return "runs are such as a laboratory rejects";
}

/// Remark on these runs besides their readings, without a final full stop; may be empty.
inline std::string remarks_on(const Specimen&, std::span<const Readings>) {
  return {};
}

}  // namespace pastefit
