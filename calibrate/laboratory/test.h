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
/// with a `Specimen`, a pair of files here with what `LaboratoryTest` asks for (calibrate/laboratory/slump.h says what
/// each does, calibrate/laboratory/default_answers.h what a kind need not say), and its row in this list.
using Test = std::variant<SlumpTest, DropTest, PelletCrush, ShearCell>;

template <class T>
concept LaboratoryTest = std::derived_from<T, Specimen> && std::default_initializable<T> &&
    requires(T test, const T given, const RunOptions& options, ObjectReader& reader, ObjectSchema& schema,
             const ReadingKind& reading, std::span<const Readings> runs, const Readings& means,
             const Snapshot& snapshot, std::span<const Measurement> measurements, std::span<const SeenRun> seen,
             std::span<const std::string_view> names) {
  { kind_of(given) } -> std::convertible_to<std::string_view>;
  { surfaces_of(test) } -> std::same_as<std::vector<Surface>>;
  { validate(given) } -> std::same_as<Faults>;
  { prepare(given, options) } -> std::same_as<std::shared_ptr<const Packing>>;
  { preparation_key(given) } -> std::same_as<std::string>;
  { grains_needed(given) } -> std::same_as<double>;
  { simulate(given, options) } -> std::same_as<Outcome>;
  { moved_time_s(given) } -> std::same_as<double>;
  { reading_kinds(given) } -> std::same_as<std::vector<ReadingKind>>;
  {read_apparatus(reader, test, Need::required)};
  {tell_apparatus(schema, test, Need::required)};
  {read_outline(reader, reading, test)};
  {ask_for(test, reading)};
  { places_in_files(given) } -> std::same_as<std::vector<FilePlace>>;
  { to_json(given) } -> std::same_as<nlohmann::json>;
  { default_test(given) } -> std::same_as<T>;
  {read_test(reader, test)};
  {tell_schema(schema, test)};
  { grain_density_of(given, means) } -> std::same_as<std::optional<double>>;
  { why_of_that_size(given) } -> std::same_as<std::string_view>;
  { series_of(given) } -> std::same_as<std::span<const std::string_view>>;
  { series_at(given, snapshot) } -> std::same_as<std::size_t>;
  { heap_at(given, snapshot) } -> std::same_as<std::optional<Outline>>;
  { outline_at(given, snapshot) } -> std::same_as<std::optional<NamedOutline>>;
  { drawings_of(given, seen, measurements) } -> std::same_as<std::vector<Drawing>>;
  { conditions_of(given) } -> std::same_as<nlohmann::ordered_json>;
  { conditions_in_words(given) } -> std::same_as<std::string>;
  { rejection_index(given, means) } -> std::same_as<std::optional<double>>;
  { rejected_runs(given) } -> std::same_as<std::string_view>;
  { remarks_on(given, runs) } -> std::same_as<std::string>;
  { check_readings(given, measurements) } -> std::same_as<ReadingCheck>;
  { yield_stresses_of(given, means) } -> std::same_as<std::vector<YieldStress>>;
  { readings_of_fluid(given, double{}) } -> std::same_as<std::optional<std::vector<PredictedReading>>>;
  { likely_strength_pa(given, means) } -> std::same_as<std::optional<LikelyRange>>;
  { unseen_by(given, names, names) } -> std::same_as<std::string>;
  { experience_of(given) } -> std::same_as<std::vector<Experience>>;
  { default_tolerance(given, Measurement{}) } -> std::same_as<double>;
};

Specimen& specimen_of(Test& test);
const Specimen& specimen_of(const Test& test);

// The same for a test of any kind, as each kind has it.
std::string_view kind_of(const Test& test);
std::vector<Surface> surfaces_of(Test& test);
std::shared_ptr<const Packing> prepare(const Test& test, const RunOptions& options = {});
std::string preparation_key(const Test& test);
double grains_needed(const Test& test);
double moved_time_s(const Test& test);
Outcome simulate(const Test& test, const RunOptions& options = {});
std::vector<ReadingKind> reading_kinds(const Test& test);
void read_apparatus(ObjectReader& apparatus, Test& test, Need need);
void read_outline(ObjectReader& reader, const ReadingKind& kind, Test& test);
void ask_for(Test& test, const ReadingKind& kind);
std::optional<double> grain_density_of(const Test& test, const Readings& means);
std::string_view why_of_that_size(const Test& test);
std::span<const std::string_view> series_of(const Test& test);
std::size_t series_at(const Test& test, const Snapshot& snapshot);
std::optional<Outline> heap_at(const Test& test, const Snapshot& snapshot);
std::optional<NamedOutline> outline_at(const Test& test, const Snapshot& snapshot);
std::vector<Drawing> drawings_of(const Test& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);
nlohmann::ordered_json conditions_of(const Test& test);
std::string conditions_in_words(const Test& test);
std::optional<double> rejection_index(const Test& test, const Readings& run);
std::string_view rejected_runs(const Test& test);
/// Whether the standards have a laboratory reject this run and repeat it.
bool is_rejected(const Test& test, const Readings& run);
/// The runs of a test that a laboratory would accept (`judge/verdict.h`).
std::vector<std::size_t> accepted(const Test& test, std::span<const Readings> runs);
std::string remarks_on(const Test& test, std::span<const Readings> runs);
ReadingCheck check_readings(const Test& test, std::span<const Measurement> measurements);
std::vector<YieldStress> yield_stresses_of(const Test& test, const Readings& means);
std::optional<std::vector<PredictedReading>> readings_of_fluid(const Test& test, double yield_stress_pa);
std::optional<LikelyRange> likely_strength_pa(const Test& test, const Readings& readings);
std::string unseen_by(const Test& test, std::span<const std::string_view> readings,
                      std::span<const std::string_view> parameters);
std::vector<Experience> experience_of(const Test& test);
/// The fields of the apparatus, and where laboratory files have them; an object behind those that it holds.
std::vector<FilePlace> places_in_files(const Test& test);
double default_tolerance(const Test& test, const Measurement& measured);

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
