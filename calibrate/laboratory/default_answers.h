#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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

/// An outline that a laboratory file may take as it is.
struct NamedOutline {
  std::string_view name;  ///< the stage of the test, e.g. "step1"
  Outline outline;
};

/// A size of a test, in the unit of its key in files, and between which values such tests are made. What lies far
/// from them is asked about.
struct Experience {
  std::string_view place;
  double value = 0, smallest = 0, largest = 0;
};

/// Yield stress of the fluid that would have a reading, by a formula from the literature.
struct YieldStress {
  std::string reading;
  std::string_view formula;  ///< its authors and year
  double pa = 0;
};

/// A reading that a fluid with a yield stress would give, by a formula from the literature.
struct PredictedReading {
  std::string_view key;  ///< in laboratory files
  std::string_view formula;
  double value = 0;               ///< in the unit of the key
  double standard_deviation = 0;  ///< the formula's own error, likewise
};

// What a kind of test answers of which nothing else is said: one that has no grains to pour and no random packing. A
// kind for which it is otherwise has an overload for its own value (calibrate/laboratory/slump.h).

/// A test that has every part, with default values.
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

/// Simulated time in which the apparatus moves [s]; to fill it and waits for rest come on top.
inline double moved_time_s(const Specimen&) {
  return 0;
}

/// A laboratory's outline; called for readings that come from one only (`ReadingKind::from_outline`).
inline void read_outline(ObjectReader&, const ReadingKind&, Specimen&) {}

/// The laboratory took a reading of this kind; called for those that are taken on request
/// (`ReadingKind::on_request`).
inline void ask_for(Specimen&, const ReadingKind&) {}

/// The surfaces that have parameters of a study. None: tools are of steel, and what is known of them is part of the
/// apparatus, or they are of the grains' material.
inline std::vector<Surface> surfaces_of(Specimen&) {
  return {};
}

/// Density of a grain [kg/m^3], from the mean readings of some runs; nothing if it is not known. What the laboratory
/// file calls the bulk density is that of a grain.
inline std::optional<double> grain_density_of(const Specimen& test, const Readings&) {
  return test.bulk_density_kg_m3;
}

/// Why the grains have to be as large as the laboratory's, for a person; empty: their size is the simulation's choice.
inline std::string_view why_of_that_size(const Specimen&) {
  return {};
}

/// The names of the series of pictures that a run may be shown in, and the one that a moment belongs to.
inline std::span<const std::string_view> series_of(const Specimen&) {
  static constexpr std::array<std::string_view, 1> only{"grains"};
  return only;
}

inline std::size_t series_at(const Specimen&, const Snapshot&) {
  return 0;
}

/// The heap as it stands at a moment of the test, from the side; nothing where there is none, as while it is prepared.
inline std::optional<Outline> heap_at(const Specimen&, const Snapshot&) {
  return std::nullopt;
}

/// What stands there is seen from the side, at moments that are worth a drawing; of one name the last counts.
inline std::optional<NamedOutline> outline_at(const Specimen&, const Snapshot&) {
  return std::nullopt;
}

/// The test as a drawing, or some: what was seen of these runs, all of one material, over what was measured.
inline std::vector<Drawing> drawings_of(const Specimen&, std::span<const SeenRun>, std::span<const Measurement>) {
  return {};
}

/// How far off a simulated reading may be where nobody says: one standard deviation of the laboratory.
inline double default_tolerance(const Specimen&, const Measurement& measured) {
  return measured.standard_deviation;
}

/// Which of these free parameters the fitted readings cannot tell from others, and what to do, for a person.
inline std::string unseen_by(const Specimen&, std::span<const std::string_view>, std::span<const std::string_view>) {
  return {};
}

/// Powders are hardly lighter than 250 kg/m^3, but in lb/ft3 and kg/l every paste is.
inline std::vector<Experience> experience_of(const Specimen& test) {
  return {{"material.bulk_density_kg_m3", test.bulk_density_kg_m3, 250, 10000}};
}

/// What these measurements, taken together, cannot be, or can hardly be.
inline ReadingCheck check_readings(const Specimen&, std::span<const Measurement>) {
  return {};
}

/// What the readings of a test say of its material as a fluid with a yield stress.
inline std::vector<YieldStress> yield_stresses_of(const Specimen&, const Readings&) {
  return {};
}

/// The readings that a fluid with this yield stress would give, in the order of the test; none where no formula holds.
/// Nothing for a kind of test for which there are no such formulas.
inline std::optional<std::vector<PredictedReading>> readings_of_fluid(const Specimen&, double) {
  return std::nullopt;
}

/// Between which values a parameter is likely to be, in its unit.
struct LikelyRange {
  double lowest = 0, highest = 0;
};

/// The strengths [Pa] (`strength_pa`) with which a test is likely to have these readings; nothing if nothing is known.
inline std::optional<LikelyRange> likely_strength_pa(const Specimen&, const Readings&) {
  return std::nullopt;
}

/// How near a run is to one that the standards have a laboratory reject and repeat: it is where this is more than 1.
/// NaN: not read; nothing for a kind of which no run is rejected.
inline std::optional<double> rejection_index(const Specimen&, const Readings&) {
  return std::nullopt;
}

/// What became of the runs that a laboratory would reject, after "6 of 8".
inline std::string_view rejected_runs(const Specimen&) {
  return "runs are such as a laboratory rejects";
}

/// What a person should know of these runs besides their readings. A line, or nothing.
inline std::string remarks_on(const Specimen&, std::span<const Readings>) {
  return {};
}

}  // namespace pastefit
