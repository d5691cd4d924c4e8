#pragma once

#include <concepts>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "calibrate/judge/verdict.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/drop.h"
#include "calibrate/laboratory/granule_tests.h"
#include "calibrate/laboratory/measurement.h"
#include "calibrate/laboratory/slump.h"

namespace pastefit {

/// Laboratory test of any kind. To add a kind: a folder in core/apparatus with the apparatus as a value that begins
/// with a `Specimen`; a pair of files here with the functions below (calibrate/laboratory/slump.h documents them,
/// calibrate/laboratory/default_answers.h has the optional ones); and a row in this list.
using Test = std::variant<SlumpTest, DropTest, PelletCrush, ShearCell>;

inline Specimen& specimen_of(Test& test) {
  return std::visit([](auto& one) -> Specimen& { return one; }, test);
}

inline const Specimen& specimen_of(const Test& test) {
  return std::visit([](const auto& one) -> const Specimen& { return one; }, test);
}

// Dispatch to the kind of a test. Not declared for a single kind, so that a missing function does not compile. What one
// place asks, it asks by `std::visit`.

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

std::string_view why_of_that_size(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return why_of_that_size(one); }, test);
}

std::optional<Outline> heap_at(const AnyKind auto& test, const Snapshot& snapshot) {
  return std::visit([&](const auto& one) { return heap_at(one, snapshot); }, test);
}

/// Outline of a heap at rest, named after the stage of the test, e.g. "step1"; can be copied into a laboratory file.
struct NamedOutline {
  std::string_view name;
  Outline outline;
};

/// Outline of the heap if it rests after a stage worth drawing; a later one replaces an earlier one of the same name.
std::optional<NamedOutline> outline_at(const Test& test, const Snapshot& snapshot);

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

/// Fields of the apparatus and their places in laboratory files; objects follow their members.
std::vector<FilePlace> places_in_files(const AnyKind auto& test) {
  return std::visit([](const auto& one) { return places_in_files(one); }, test);
}

/// True if the standards reject this run, so that the test must be repeated.
bool is_rejected(const Test& test, const Readings& run);
/// The accepted ones (`judge/verdict.h`) of runs with `readings`.
template <class Runs>
auto accepted(const Test& test, const Runs& runs) {
  std::vector<bool> rejected;
  for (const auto& run : runs) rejected.push_back(is_rejected(test, run.readings));
  std::vector<typename Runs::value_type> out;
  for (const std::size_t i : accepted(rejected)) out.push_back(runs[i]);
  return out;
}

/// Returns every fault that prevents the simulation; places are paths in the test's JSON.
Faults validate(const Test& test);

/// `validate` with places in laboratory and apparatus files, e.g. "apparatus.mould.height_mm".
Faults validate_in_file_words(const Test& test);

/// Words for all kinds, in the order of `Test`.
std::vector<std::string_view> kinds_of_tests();

/// Test of this kind with default values; nothing if unknown.
std::optional<Test> test_of_kind(std::string_view kind);

Fault no_such_kind(std::string where, std::string_view word);

/// Names of all starting files: "lab" and "study" for the first kind, prefixed by their word for others; the sheet to
/// print.
std::vector<std::string> template_names();

/// Starting file (laboratory/templates): JSON with comments, valid as it is, whose study refers to "lab.json" in its
/// folder; or measuring sheet for printing (HTML, A4) whose heads `sheet_table` reads, in English or German
/// ("sheet-de"). "lab-PRESET" and "study-PRESET": those of a preset with its own starting files, the lifted cylinder,
/// whose tests are of materials other than pastes. Nothing for unknown names.
std::optional<std::string> template_text(std::string_view name);

/// Readings of all kinds of tests, with default values.
std::vector<ReadingKind> all_reading_kinds();

/// Converts a test to JSON in SI, with the unit in each key: the canonical form for cards and stored evaluations. Equal
/// tests give equal text (keys sorted, doubles with round-trip precision). Requirement: every number is finite.
nlohmann::json to_json(const Test& test);

/// Parses the result of `to_json`. Keys without a default are required; default of the kind: slump test. Errors: every
/// fault of form, otherwise every fault of `validate`; places are paths in the JSON.
Result<Test> test_from_json(const nlohmann::json& document);

/// JSON schema of `to_json`, one form per kind; common parts go to the definitions of `schema`.
nlohmann::ordered_json schema_of_tests(ObjectSchema& schema);

/// JSON schema of "apparatus" in laboratory files, which may name a preset, and in apparatus files.
nlohmann::ordered_json schema_of_apparatus(ObjectSchema& schema, bool presets);

/// Part of a JSON value that differs from the default: of objects the differing members, recursively; lists and numbers
/// as a whole. Values with equal differing parts from the same default are equal.
nlohmann::json differing_part(const nlohmann::json& value, const nlohmann::json& by_default);

/// Identity of a test: its kind, and the part of its JSON that differs from the default. A new field with its default
/// value does not change it.
nlohmann::json identity_of(const Test& test);

}  // namespace pastefit
