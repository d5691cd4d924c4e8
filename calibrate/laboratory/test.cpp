#include "calibrate/laboratory/test.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/object_schema.h"
#include "calibrate/base/object_writer.h"
#include "calibrate/base/units.h"
#include "core/apparatus/field_checker.h"

namespace pastefit {
namespace {

using nlohmann::json;

/// Calls `visit(Kind{})` for every kind.
void each_kind(const auto& visit) {
  const auto all = [&]<std::size_t... row>(std::index_sequence<row...>) {
    (visit(std::variant_alternative_t<row, Test>{}), ...);
  };
  all(std::make_index_sequence<std::variant_size_v<Test>>{});
}

/// Converts a fault of a field in SI to the unit of a file's key: millimetres, degrees, or a diameter.
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

std::optional<NamedOutline> outline_at(const Test& test, const Snapshot& snapshot) {
  const std::string_view phase = snapshot.phase;
  if (!phase.ends_with(".rest") || phase.starts_with("drops.")) return std::nullopt;
  auto heap = heap_at(test, snapshot);
  return heap ? std::optional(NamedOutline{phase.substr(0, phase.find('.')), std::move(*heap)}) : std::nullopt;
}

bool is_rejected(const Test& test, const Readings& run) {
  return is_rejected(rejection_index(test, run).value_or(0));
}

Faults validate(const Test& test) {
  return std::visit([](const auto& one) { return validate(one); }, test);
}

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
  each_kind([&](const auto& kind) { words.push_back(kind_of(kind)); });
  return words;
}

std::optional<Test> test_of_kind(std::string_view word) {
  std::optional<Test> test;
  each_kind([&](const auto& kind) {
    if (kind_of(kind) == word) test = kind;
  });
  return test;
}

Fault no_such_kind(std::string where, std::string_view word) {
  return {std::move(where), "there is no test " + in_quotes(word), "one of: " + listed(kinds_of_tests())};
}

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const std::string_view kind : kinds_of_tests()) {
    const std::string before = names.empty() ? "" : std::string(kind) + "-";
    names.insert(names.end(), {before + "lab", before + "study"});
  }
  names.insert(names.end(), {"sheet", "sheet-de"});
  return names;
}

std::optional<std::string> template_text(std::string_view name) {
  const std::string ending = name.starts_with("sheet") ? ".html" : ".json";
  return std::optional<std::string>(embedded_text("laboratory/templates/" + std::string(name) + ending));
}

std::vector<ReadingKind> all_reading_kinds() {
  std::vector<ReadingKind> all;
  each_kind([&](const auto& kind) {
    const auto own = reading_kinds(default_test(kind));
    all.insert(all.end(), own.begin(), own.end());
  });
  return all;
}

json to_json(const Test& test) {
  json document;
  ObjectWriter writer(document);
  std::visit([&](auto one) { describe_test(writer, one); }, test);
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
    std::visit([&](auto& one) { describe_test(reader, one); }, *test);
  }
  if (faults.empty()) faults = validate(*test);
  if (!faults.empty()) return faults;
  return *test;
}

nlohmann::ordered_json schema_of_tests(ObjectSchema& schema) {
  auto forms = nlohmann::ordered_json::array();
  each_kind([&](auto kind) {
    forms.push_back(schema.described([&](ObjectSchema& form) {
      const Need need = kind_of(kind) == "slump" ? Need::optional : Need::required;
      form.constant({"kind", "kind of laboratory test; default slump"}, kind_of(kind), need);
      describe_test(form, kind);
    }));
  });
  return {{"oneOf", forms}};
}

nlohmann::ordered_json schema_of_apparatus(ObjectSchema& schema, bool presets) {
  auto forms = nlohmann::ordered_json::array();
  if (presets)
    forms.push_back(schema.described([](ObjectSchema& form) {
      form.text({"preset",
                 "name of a file in data/apparatus, without .json; other keys of `apparatus` replace the values in "
                 "that file"},
                "", Need::required);
      SlumpTest any;
      describe_apparatus(form, any, Need::optional);
    }));
  each_kind([&](auto kind) {
    forms.push_back(schema.described([&](ObjectSchema& form) { describe_apparatus(form, kind, Need::required); }));
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
  const Test by_default = std::visit([](const auto& one) -> Test { return default_test(one); }, test);
  return {kind_of(test), differing_part(to_json(test), to_json(by_default))};
}

}  // namespace pastefit
