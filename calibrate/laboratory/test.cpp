#include "calibrate/laboratory/test.h"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/object_schema.h"
#include "calibrate/base/units.h"
#include "calibrate/judge/verdict.h"
#include "core/apparatus/field_checker.h"

namespace pastefit {
namespace {

using nlohmann::json;

template <class... Kinds>
constexpr bool are_laboratory_tests(const std::variant<Kinds...>*) {
  return (LaboratoryTest<Kinds> && ...);
}
static_assert(are_laboratory_tests(static_cast<const Test*>(nullptr)), "a kind of test lacks something");

/// Calls `visit(Kind{})` for every kind until one returns true.
template <class Visitor>
void each_kind(const Visitor& visit) {
  const auto all = [&]<std::size_t... row>(std::index_sequence<row...>) {
    (void)(visit(std::variant_alternative_t<row, Test>{}) || ...);
  };
  all(std::make_index_sequence<std::variant_size_v<Test>>{});
}

}  // namespace

Specimen& specimen_of(Test& test) {
  return std::visit([](auto& one) -> Specimen& { return one; }, test);
}

const Specimen& specimen_of(const Test& test) {
  return std::visit([](const auto& one) -> const Specimen& { return one; }, test);
}

std::string_view kind_of(const Test& test) {
  return std::visit([](const auto& one) { return kind_of(one); }, test);
}

std::vector<Surface> surfaces_of(Test& test) {
  return std::visit([](auto& one) { return surfaces_of(one); }, test);
}

std::shared_ptr<const Packing> prepare(const Test& test, const RunOptions& options) {
  return std::visit([&](const auto& one) { return prepare(one, options); }, test);
}

std::string preparation_key(const Test& test) {
  return std::visit([](const auto& one) { return preparation_key(one); }, test);
}

double moved_time_s(const Test& test) {
  return std::visit([](const auto& one) { return moved_time_s(one); }, test);
}

double grains_needed(const Test& test) {
  return std::visit([](const auto& one) { return grains_needed(one); }, test);
}

Outcome simulate(const Test& test, const RunOptions& options) {
  return std::visit([&](const auto& one) { return simulate(one, options); }, test);
}

std::vector<ReadingKind> reading_kinds(const Test& test) {
  return std::visit([](const auto& one) { return reading_kinds(one); }, test);
}

void read_apparatus(ObjectReader& apparatus, Test& test, Need need) {
  std::visit([&](auto& one) { read_apparatus(apparatus, one, need); }, test);
}

void read_outline(ObjectReader& reader, const ReadingKind& kind, Test& test) {
  std::visit([&](auto& one) { read_outline(reader, kind, one); }, test);
}

void ask_for(Test& test, const ReadingKind& kind) {
  std::visit([&](auto& one) { ask_for(one, kind); }, test);
}

std::optional<double> grain_density_of(const Test& test, const Readings& means) {
  return std::visit([&](const auto& one) { return grain_density_of(one, means); }, test);
}

std::string_view why_of_that_size(const Test& test) {
  return std::visit([](const auto& one) { return why_of_that_size(one); }, test);
}

std::span<const std::string_view> series_of(const Test& test) {
  return std::visit([](const auto& one) { return series_of(one); }, test);
}

std::size_t series_at(const Test& test, const Snapshot& snapshot) {
  return std::visit([&](const auto& one) { return series_at(one, snapshot); }, test);
}

std::optional<Outline> heap_at(const Test& test, const Snapshot& snapshot) {
  return std::visit([&](const auto& one) { return heap_at(one, snapshot); }, test);
}

std::optional<NamedOutline> outline_at(const Test& test, const Snapshot& snapshot) {
  return std::visit([&](const auto& one) { return outline_at(one, snapshot); }, test);
}

std::vector<Drawing> drawings_of(const Test& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured) {
  return std::visit([&](const auto& one) { return drawings_of(one, runs, measured); }, test);
}

nlohmann::ordered_json conditions_of(const Test& test) {
  return std::visit([](const auto& one) { return conditions_of(one); }, test);
}

std::string conditions_in_words(const Test& test) {
  return std::visit([](const auto& one) { return conditions_in_words(one); }, test);
}

std::optional<double> rejection_index(const Test& test, const Readings& run) {
  return std::visit([&](const auto& one) { return rejection_index(one, run); }, test);
}

std::string_view rejected_runs(const Test& test) {
  return std::visit([](const auto& one) { return rejected_runs(one); }, test);
}

bool is_rejected(const Test& test, const Readings& run) {
  return is_rejected(rejection_index(test, run).value_or(0));
}

std::vector<std::size_t> accepted(const Test& test, std::span<const Readings> runs) {
  std::vector<bool> rejected;
  for (const Readings& run : runs) rejected.push_back(is_rejected(test, run));
  return accepted(rejected);
}

std::string remarks_on(const Test& test, std::span<const Readings> runs) {
  return std::visit([&](const auto& one) { return remarks_on(one, runs); }, test);
}

ReadingCheck check_readings(const Test& test, std::span<const Measurement> measurements) {
  return std::visit([&](const auto& one) { return check_readings(one, measurements); }, test);
}

std::vector<YieldStress> yield_stresses_of(const Test& test, const Readings& means) {
  return std::visit([&](const auto& one) { return yield_stresses_of(one, means); }, test);
}

std::optional<std::vector<PredictedReading>> readings_of_fluid(const Test& test, double yield_stress_pa) {
  return std::visit([&](const auto& one) { return readings_of_fluid(one, yield_stress_pa); }, test);
}

std::optional<LikelyRange> likely_strength_pa(const Test& test, const Readings& readings) {
  return std::visit([&](const auto& one) { return likely_strength_pa(one, readings); }, test);
}

double default_tolerance(const Test& test, const Measurement& measured) {
  return std::visit([&](const auto& one) { return default_tolerance(one, measured); }, test);
}

std::string unseen_by(const Test& test, std::span<const std::string_view> readings,
                      std::span<const std::string_view> parameters) {
  return std::visit([&](const auto& one) { return unseen_by(one, readings, parameters); }, test);
}

std::vector<FilePlace> places_in_files(const Test& test) {
  return std::visit([](const auto& one) { return places_in_files(one); }, test);
}

std::vector<Experience> experience_of(const Test& test) {
  return std::visit([](const auto& one) { return experience_of(one); }, test);
}

Faults validate(const Test& test) {
  return std::visit([](const auto& one) { return validate(one); }, test);
}

namespace {

/// The same fault of a field in SI for the key of a file: in millimetres or degrees, where the key is, and of a
/// diameter.
Fault in_unit_of(std::string_view field, Fault fault) {
  const std::string& key = fault.where;
  if (!fault.range) return fault;
  const bool in_mm = key.find("_mm") != std::string::npos && field.find("_mm") == std::string_view::npos;
  const bool doubled = key.find("diameter") != std::string::npos && field.find("radius") != std::string_view::npos;
  const bool in_degrees = key.ends_with("_deg");
  const double scale = (in_mm ? mm : in_degrees ? degrees : 1) * (doubled ? 2 : 1);
  OutOfRange range = *fault.range;
  for (double* number : {&range.value, &range.smallest, &range.largest}) *number *= scale;
  if (in_mm) range.unit = "m" + range.unit;
  if (in_degrees) range.unit = "degrees";
  return FieldChecker::fault_of(key, std::move(range));
}

}  // namespace

Faults validate_in_file_words(const Test& test) {
  static const std::vector<FilePlace> specimen{{"bulk_density_kg_m3", "material.bulk_density_kg_m3"},
                                               {"grains.radius_m", "grains.radius_mm"},
                                               {"grains.standard_deviation_m", "grains.standard_deviation_mm"},
                                               {"grains.smallest_m", "grains.smallest_mm"},
                                               {"grains.largest_m", "grains.largest_mm"},
                                               {"contact.bridge.viscosity_pa_s", "parameters.viscosity_pa_s"},
                                               {"contact", "parameters: contact"}};
  const auto renamed = [](Fault& fault, const std::vector<FilePlace>& places) {
    for (const FilePlace& one : places) {
      if (!fault.where.starts_with(one.field)) continue;
      if (fault.where.size() > one.field.size() && fault.where[one.field.size()] != '.') continue;
      const std::string field = fault.where;
      fault.where.replace(0, one.field.size(), one.place);
      fault = in_unit_of(field, std::move(fault));
      return true;
    }
    return false;
  };
  Faults faults = validate(test);
  const std::vector<FilePlace> own = places_in_files(test);
  for (Fault& fault : faults)
    if (!renamed(fault, own)) renamed(fault, specimen);
  return faults;
}

std::vector<std::string_view> kinds_of_tests() {
  std::vector<std::string_view> words;
  each_kind([&](const auto& kind) {
    words.push_back(kind_of(kind));
    return false;
  });
  return words;
}

std::optional<Test> test_of_kind(std::string_view word) {
  std::optional<Test> test;
  each_kind([&](const auto& kind) {
    if (kind_of(kind) == word) test = kind;
    return test.has_value();
  });
  return test;
}

Fault no_such_kind(std::string where, std::string_view word) {
  std::string known;
  for (const std::string_view kind : kinds_of_tests()) known += (known.empty() ? "" : ", ") + std::string(kind);
  return {std::move(where), "there is no test " + in_quotes(word), "one of: " + known};
}

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const std::string_view kind : kinds_of_tests()) {
    const std::string before = names.empty() ? "" : std::string(kind) + "-";
    names.insert(names.end(), {before + "lab", before + "study"});
  }
  return names;
}

std::optional<std::string> template_text(std::string_view name) {
  return std::optional<std::string>(embedded_text("laboratory/templates/" + std::string(name) + ".json"));
}

std::optional<std::string> template_text_of_mould(std::string_view name, std::string_view preset) {
  if (name != "lab" && name != "study") return std::nullopt;
  return template_text(std::string(name) + "-" + std::string(preset));
}

std::vector<ReadingKind> all_reading_kinds() {
  std::vector<ReadingKind> all;
  each_kind([&](const auto& kind) {
    const auto own = reading_kinds(default_test(kind));
    all.insert(all.end(), own.begin(), own.end());
    return false;
  });
  return all;
}

json to_json(const Test& test) {
  json document = std::visit([](const auto& one) { return to_json(one); }, test);
  document["kind"] = kind_of(test);
  return document;
}

Result<Test> test_from_json(const json& document) {
  if (!document.is_object()) return Fault{"", "a test must be an object", "write { ... }"};
  Faults faults;
  std::optional<Test> test;
  {
    ObjectReader reader(document, "", faults);
    std::string word = "slump";
    reader.text("kind", word, Need::optional);
    test = test_of_kind(word);
    if (!test) return no_such_kind("kind", word);
    std::visit([&](auto& one) { read_test(reader, one); }, *test);
  }
  if (faults.empty()) faults = validate(*test);
  if (!faults.empty()) return faults;
  return *test;
}

nlohmann::ordered_json schema_of_tests(ObjectSchema& schema) {
  auto forms = nlohmann::ordered_json::array();
  each_kind([&](const auto& kind) {
    forms.push_back(schema.described([&](ObjectSchema& form) {
      const Need need = kind_of(kind) == "slump" ? Need::optional : Need::required;
      form.constant({"kind", "which laboratory test; a slump test where it is not said"}, kind_of(kind), need);
      tell_schema(form, kind);
    }));
    return false;
  });
  return {{"oneOf", forms}};
}

nlohmann::ordered_json schema_of_apparatus(ObjectSchema& schema, bool presets) {
  auto forms = nlohmann::ordered_json::array();
  if (presets)
    forms.push_back(schema.described([](ObjectSchema& form) {
      form.text({"preset",
                 "name of a file of data/apparatus without .json; what stands beside it replaces what the file says"},
                "", Need::required);
      tell_apparatus(form, SlumpTest(), Need::optional);
    }));
  each_kind([&](const auto& kind) {
    forms.push_back(schema.described([&](ObjectSchema& form) { tell_apparatus(form, kind, Need::required); }));
    return false;
  });
  return {{"oneOf", forms}};
}

json differing_part(const json& value, const json& by_default) {
  if (!value.is_object() || !by_default.is_object()) return value;
  json part = json::object();
  for (const auto& [key, member] : value.items()) {
    const auto known = by_default.find(key);
    if (known == by_default.end())
      part[key] = member;
    else if (member != *known)
      part[key] = differing_part(member, *known);
  }
  return part;
}

json identity_of(const Test& test) {
  const auto by_default = std::visit([](const auto& one) { return to_json(default_test(one)); }, test);
  return {kind_of(test), differing_part(std::visit([](const auto& one) { return to_json(one); }, test), by_default)};
}

}  // namespace pastefit
