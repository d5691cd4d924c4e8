#pragma once

#include <concepts>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/drop.h"
#include "calibrate/laboratory/measurement.h"
#include "calibrate/laboratory/pellet.h"
#include "calibrate/laboratory/shear.h"
#include "calibrate/laboratory/slump.h"

namespace pastefit {

/// A laboratory test of any kind. To add a kind: a folder in core/apparatus with the apparatus as a value that begins
/// with a `Specimen`, a pair of files here with what is asked of each kind below (calibrate/laboratory/slump.h says
/// what each does, calibrate/laboratory/default_answers.h what a kind need not say), and its row in this list.
using Test = std::variant<SlumpTest, DropTest, PelletCrush, ShearCell>;

inline Specimen& specimen_of(Test& test) {
  return std::visit([](auto& one) -> Specimen& { return one; }, test);
}

inline const Specimen& specimen_of(const Test& test) {
  return std::visit([](const auto& one) -> const Specimen& { return one; }, test);
}

// What each kind answers, of a test of any kind. Not of one by itself: what a kind lacks does not compile.

template <class T>
concept AnyKind = std::same_as<T, Test>;

std::string_view kind_of(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return kind_of(one); }, test);
}

std::vector<Surface> surfaces_of(AnyKind auto& test) {
  return std::visit([](auto& one) { return surfaces_of(one); }, test);
}

std::shared_ptr<const Packing> prepare(const AnyKind auto& test, const RunOptions& options = {}) {
  return std::visit([&](const auto& one) { return prepare(one, options); }, test);
}

std::string preparation_key(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return preparation_key(one); }, test);
}

double grains_needed(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return grains_needed(one); }, test);
}

double moved_time_s(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return moved_time_s(one); }, test);
}

Outcome simulate(const AnyKind auto& test, const RunOptions& options = {}) {
  return std::visit([&](const auto& one) { return simulate(one, options); }, test);
}

std::vector<ReadingKind> reading_kinds(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return reading_kinds(one); }, test);
}

void read_outline(ObjectReader& reader, const ReadingKind& kind, AnyKind auto& test) {
  std::visit([&](auto& one) { read_outline(reader, kind, one); }, test);
}

void ask_for(AnyKind auto& test, const ReadingKind& kind) {
  std::visit([&](auto& one) { ask_for(one, kind); }, test);
}

std::optional<double> grain_density_of(const AnyKind auto& test, const Readings& means) {
  return std::visit([&](const auto& one) { return grain_density_of(one, means); }, test);
}

std::string_view why_of_that_size(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return why_of_that_size(one); }, test);
}

std::span<const std::string_view> series_of(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return series_of(one); }, test);
}

std::size_t series_at(const AnyKind auto& test, const Snapshot& snapshot) {
  return std::visit([&](const auto& one) { return series_at(one, snapshot); }, test);
}

std::optional<Outline> heap_at(const AnyKind auto& test, const Snapshot& snapshot) {
  return std::visit([&](const auto& one) { return heap_at(one, snapshot); }, test);
}

std::optional<NamedOutline> outline_at(const AnyKind auto& test, const Snapshot& snapshot) {
  return std::visit([&](const auto& one) { return outline_at(one, snapshot); }, test);
}

std::vector<Drawing> drawings_of(const AnyKind auto& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured) {
  return std::visit([&](const auto& one) { return drawings_of(one, runs, measured); }, test);
}

nlohmann::ordered_json conditions_of(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return conditions_of(one); }, test);
}

std::string conditions_in_words(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return conditions_in_words(one); }, test);
}

std::optional<double> rejection_index(const AnyKind auto& test, const Readings& run) {
  return std::visit([&](const auto& one) { return rejection_index(one, run); }, test);
}

std::string_view rejected_runs(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return rejected_runs(one); }, test);
}

std::string remarks_on(const AnyKind auto& test, std::span<const Readings> runs) {
  return std::visit([&](const auto& one) { return remarks_on(one, runs); }, test);
}

ReadingCheck check_readings(const AnyKind auto& test, std::span<const Measurement> measurements) {
  return std::visit([&](const auto& one) { return check_readings(one, measurements); }, test);
}

std::vector<YieldStress> yield_stresses_of(const AnyKind auto& test, const Readings& means) {
  return std::visit([&](const auto& one) { return yield_stresses_of(one, means); }, test);
}

std::optional<std::vector<PredictedReading>> readings_of_fluid(const AnyKind auto& test, double yield_stress_pa) {
  return std::visit([&](const auto& one) { return readings_of_fluid(one, yield_stress_pa); }, test);
}

std::optional<LikelyRange> likely_strength_pa(const AnyKind auto& test, const Readings& readings) {
  return std::visit([&](const auto& one) { return likely_strength_pa(one, readings); }, test);
}

std::string unseen_by(const AnyKind auto& test, std::span<const std::string_view> readings,
                      std::span<const std::string_view> parameters) {
  return std::visit([&](const auto& one) { return unseen_by(one, readings, parameters); }, test);
}

std::vector<Experience> experience_of(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return experience_of(one); }, test);
}

/// The fields of the apparatus, and where laboratory files have them; an object behind those that it holds.
std::vector<FilePlace> places_in_files(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return places_in_files(one); }, test);
}

double default_tolerance(const AnyKind auto& test, const Measurement& measured) {
  return std::visit([&](const auto& one) { return default_tolerance(one, measured); }, test);
}

/// Whether the standards have a laboratory reject this run and repeat it.
bool is_rejected(const Test& test, const Readings& run);
/// The runs of a test that a laboratory would accept (`judge/verdict.h`).
std::vector<std::size_t> accepted(const Test& test, std::span<const Readings> runs);

void read_apparatus(ObjectReader& apparatus, Test& test, Need need);

/// Every fault that keeps the test from being simulated; places are paths in its JSON.
Faults validate(const Test& test);

/// The same, with places in the words of laboratory and apparatus files, e.g. "apparatus.mould.height_mm".
Faults validate_in_file_words(const Test& test);

/// The words of all kinds, in the order of `Test`.
std::vector<std::string_view> kinds_of_tests();

/// A test of this kind with default values; nothing if there is no such kind.
std::optional<Test> test_of_kind(std::string_view kind);

/// The fault of a word that no kind has.
Fault no_such_kind(std::string where, std::string_view word);

/// The names of all starting files: "lab" and "study" of the first kind, of others with their word before.
std::vector<std::string> template_names();

/// A commented starting file (laboratory/templates), fit to be read as it is; the study names its laboratory file
/// "lab.json", beside it. Nothing if there is none of that name.
std::optional<std::string> template_text(std::string_view name);

/// "lab" or "study" for an apparatus preset that has starting files of its own: the lifted cylinder, whose tests are of
/// other materials than pastes. Nothing for others.
std::optional<std::string> template_text_of_mould(std::string_view name, std::string_view preset);

/// The readings of all kinds of tests, with the default values.
std::vector<ReadingKind> all_reading_kinds();

/// The test as JSON, complete and in SI, the unit in each key: the canonical form for cards and stored evaluations.
/// The same test gives the same text (keys sorted, doubles written so that they read back bit for bit).
/// Requirement: every number is finite.
nlohmann::json to_json(const Test& test);

/// Reads what `to_json` writes; every key must be there, but the kind, without which it is a slump test.
/// Errors: every fault of form, or else every fault that `validate` finds; places are paths in the JSON.
Result<Test> test_from_json(const nlohmann::json& document);

/// The JSON schema of the same, one form for each kind; what they share goes to the definitions of `schema`.
nlohmann::ordered_json schema_of_tests(ObjectSchema& schema);

/// The JSON schema of "apparatus" in laboratory files, where it may have a preset, and apparatus files.
nlohmann::ordered_json schema_of_apparatus(ObjectSchema& schema, bool presets);

/// The part of a JSON value that differs from the default one: of an object its members that do, each likewise; whole
/// lists and numbers. Two values with the same part of the same default value are the same.
nlohmann::json differing_part(const nlohmann::json& value, const nlohmann::json& by_default);

/// What tells the test from others: its kind, and the part of its JSON that differs from that of the default. A field
/// that is added with its default value gives it no other name.
nlohmann::json identity_of(const Test& test);

}  // namespace pastefit
