#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/laboratory/default_answers.h"
#include "calibrate/laboratory/dimension_json.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/heap_shape.h"
#include "calibrate/laboratory/measurement.h"
#include "calibrate/laboratory/specimen_json.h"
#include "calibrate/laboratory/yield_stress.h"
#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"

namespace pastefit {

// The slump test in the words of files and people: what `LaboratoryTest` (calibrate/laboratory/test.h) asks of a kind.

inline constexpr std::string_view kind_of(const SlumpTest&) {
  return "slump";
}

std::vector<Surface> surfaces_of(SlumpTest& test);

/// Pours the grains into the mould. Tests of one laboratory file with the same seed and key share what that gives.
std::shared_ptr<const Packing> prepare(const SlumpTest& test, const RunOptions& options);
std::string preparation_key(const SlumpTest& test);
double grains_needed(const SlumpTest& test);

/// The keys of "apparatus" in laboratory and apparatus files, in millimetres.
void read_apparatus(ObjectReader& apparatus, SlumpTest& test, Need need);
void tell_apparatus(ObjectSchema& schema, SlumpTest any, Need need);

/// The outline of a heap seen from the side, which a reading of this kind is the distance from.
void read_outline(ObjectReader& reader, const ReadingKind& kind, SlumpTest& test);

/// Has the test take a reading of this kind, which the laboratory took (`ReadingKind::on_request`), where its apparatus
/// does not say how: as by default.
void ask_for(SlumpTest& test, const ReadingKind& kind);

/// The apparatus' places in `validate`'s words and in those of laboratory and apparatus files.
std::vector<FilePlace> places_in_files(const SlumpTest&);

/// Of the mould, until it is off the heap.
double moved_time_s(const SlumpTest& test);

/// Complete and in SI, the unit in each key.
nlohmann::json to_json(const SlumpTest& test);
/// A test that has every part, with default values.
SlumpTest default_test(const SlumpTest&);
/// Reads what `to_json` writes; every key must be there. Faults of form only.
void read_test(ObjectReader& reader, SlumpTest& test);
/// The schema of the same; `any` is any test of the kind.
void tell_schema(ObjectSchema& schema, SlumpTest any);

/// Of the grains, such that the mould holds the bulk density.
std::optional<double> grain_density_of(const SlumpTest& test, const Readings& means);

/// The mould being filled, the test, and the second drop of its heap, each with a clock of its own.
std::span<const std::string_view> series_of(const SlumpTest& test);
std::size_t series_at(const SlumpTest& test, const Snapshot& snapshot);

/// Of the drops of one heap the first counts.
std::optional<Outline> heap_at(const SlumpTest& test, const Snapshot& snapshot);

/// The heap at rest after each step, for a photograph beside it.
std::optional<NamedOutline> outline_at(const SlumpTest& test, const Snapshot& snapshot);

/// The heap after each step from the side, in millimetres (calibrate/laboratory/slump_drawing.cpp).
std::vector<Drawing> drawings_of(const SlumpTest& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

/// One standard deviation of the laboratory, but half a grain's radius at least: heaps of grains have no finer surface.
/// Of the shift of the top where a heap has sheared off.
double default_tolerance(const SlumpTest& test, const Measurement& measured);

/// Friction shapes the width of a heap; its height alone cannot tell friction from strength.
std::string unseen_by(const SlumpTest& test, std::span<const std::string_view> readings,
                      std::span<const std::string_view> parameters);

/// Fresh foams, pastes and heavy concretes, in moulds from a small tube to the cone of a dam's concrete.
std::vector<Experience> experience_of(const SlumpTest& test);

/// What a fit in this test was made for, for cards, and in words.
nlohmann::ordered_json conditions_of(const SlumpTest& test);
std::string conditions_in_words(const SlumpTest& test);

/// How far its top shifted (`shear_index`): EN 12350-2 and ASTM C143 have the test of a heap that sheared off repeated.
std::optional<double> rejection_index(const SlumpTest& test, const Readings& run);

std::string_view rejected_runs(const SlumpTest& test);

/// What a person should know of these runs besides their readings: heaps that sheared off. A line, or nothing.
std::string remarks_on(const SlumpTest& test, std::span<const Readings> runs);

/// Outlines and spread curves of a slump test that are in another frame or unit than the files': off a picture's edge,
/// downwards, in centimetres, as a radius. Adds a fault for each.
void check_curves(const SlumpTest& test, ReadingCheck& check);

}  // namespace pastefit
