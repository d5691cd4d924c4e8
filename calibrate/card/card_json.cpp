#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/embedded_text.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/card/card_description.h"

namespace pastefit {

using nlohmann::json;
using nlohmann::ordered_json;

namespace card_fields {

BaselineColumns baseline_columns(const Baseline& baseline) {
  BaselineColumns columns;
  for (const Baseline::Run& run : baseline.runs) {
    columns.packings.push_back(run.packing);
    for (const auto& [name, value] : run.readings.all()) {
      auto column = std::ranges::find(columns.readings, name, &BaselineColumns::Column::name);
      if (column == columns.readings.end()) column = columns.readings.insert(column, {name, {}});
      column->values.push_back(value);
    }
  }
  return columns;
}

std::vector<Baseline::Run> baseline_runs(const BaselineColumns& columns) {
  std::vector<Baseline::Run> runs;
  for (const std::uint64_t packing : columns.packings) runs.push_back({packing, {}});
  for (const auto& [name, values] : columns.readings)
    if (values.size() == runs.size())  // else a fault was reported
      for (std::size_t i = 0; i < runs.size(); ++i) runs[i].readings.set(name, values[i]);
  return runs;
}

std::vector<std::string> failure_names() {
  std::vector<std::string> names;
  for (int reason = 0; reason <= static_cast<int>(FailureReason::stopped); ++reason)
    names.emplace_back(name_of(static_cast<FailureReason>(reason)));
  return names;
}

/// Uses the reader of the test for its fields. Missing parts are the material's, and so are faults in them.
bool describe_test(ObjectReader& fields, const Key& key, CardTest& test, const json* material) {
  fields.known(key);
  const json* given = fields.content(key);
  json document = given ? *given : json();
  std::set<std::string> taken;
  for (const std::string part : of_material)
    if (document.is_object() && !document.contains(part)) {
      taken.insert(part);
      if (material && material->is_object() && material->contains(part)) document[part] = (*material)[part];
    }
  const auto read = test_from_json(document);
  if (read.ok()) test.test = read.value();
  if (read.ok()) return true;
  Faults& faults = fields.faults();
  for (const auto& fault : read.faults()) {
    if (!taken.contains(fault.where.substr(0, fault.where.find('.')))) {
      const std::string place = fields.place(key);
      faults.push_back({fault.where.empty() ? place : joined(place, fault.where), fault.what, fault.remedy});
      continue;
    }
    const std::string where = joined("material", fault.where);
    if (material && material->is_object() && std::ranges::find(faults, where, &Fault::where) == faults.end())
      faults.push_back({where, fault.what, fault.remedy});
  }
  return false;
}

bool describe_test(OrderedObjectWriter& fields, const Key& key, const CardTest& test, const Material& material) {
  json shared;
  ObjectWriter writer(shared);
  describe_material(writer, material);
  json own = to_json(test.test);
  for (const char* part : of_material)
    if (own.at(part) == shared.at(part)) own.erase(part);
  fields.derived_object(
      key, [&] { return own; }, 0);
  return true;
}

bool describe_test(ObjectSchema& fields, const Key& key, const CardTest&, const Material&) {
  ordered_json tests = schema_of_tests(fields);
  for (ordered_json& form : tests["oneOf"]) {
    auto& needed = form["required"];
    std::erase_if(needed.get_ref<ordered_json::array_t&>(),
                  [](const ordered_json& part) { return std::ranges::find(of_material, part) != of_material.end(); });
  }
  fields.put(key, std::move(tests), Need::required);
  return false;
}

namespace {

constexpr std::string_view prefix = "pastefit-card-";

std::string format_of(int version) {
  return std::string(prefix) + std::to_string(version);
}

void rename(json& object, const char* before, const char* now) {
  if (!object.is_object() || !object.contains(before)) return;
  json value = std::move(object[before]);
  object.erase(before);
  object[now] = std::move(value);
}

/// Version 6 renamed some keys of version 5.
void translate_from_5(json& card) {
  const auto for_each = [&](const char* list, auto body) {
    if (card.contains(list) && card[list].is_array())
      for (json& one : card[list]) body(one);
  };
  for_each("tests", [](json& test) { rename(test, "observables", "readings"); });
  for_each("further_confirmations", [](json& one) { rename(one, "misfit", "error"); });
  if (!card.contains("confirmation")) return;
  rename(card["confirmation"], "misfit", "error");
  rename(card["confirmation"], "rejected_share_allowed", "rejected_share");
}

/// Errors if a document is not a card, or a card of another version; empty if it is one.
Faults format_faults(const json& document) {
  const std::string known = format_of(kCardVersion);
  Faults faults;
  if (!is_card(document))
    has_format(document, known, faults);
  else if (const auto format = document["format"].get<std::string>(); format != known && format != format_of(5))
    faults.push_back({"format",
                      "is \"" + format + "\"; this program reads \"" + format_of(5) + "\" and \"" + known + "\"",
                      "use the version of pastefit that wrote the card, or a newer one"});
  return faults;
}

/// Several tests need different names.
void check_names(ObjectReader& card, const std::vector<CardTest>& tests) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < tests.size() && tests.size() > 1; ++i)
    if (tests[i].name.empty() || !names.insert(tests[i].name).second)
      card.fault("tests[" + std::to_string(i) + "].name", "is " + in_quotes(tests[i].name),
                 "of several tests each has a name of its own");
}

/// A card has its contact laws twice: scale-free (`Material::parameters`) and in SI, for the material's grains and
/// those of its tests. Adds a fault for every number in SI that differs from the scale-free form beyond nine digits,
/// which shows an edit in one place only. For a and b, small differences of larger numbers, the digits are those of the
/// larger numbers.
void compare(const std::string& place, const json& in_si, const json& expected, const Bridge& bridge, Faults& faults) {
  const bool polynomial = bridge.shape == BridgeShape::polynomial;
  const auto scale_of = [&](const std::string& key, double number) {
    if (polynomial && key.ends_with("bridge/a_n_m2")) return bridge.c_n / (bridge.d_c_m * bridge.d_c_m);
    if (polynomial && key.ends_with("bridge/b_n_m")) return bridge.c_n / -bridge.d_c_m;
    return std::abs(number);
  };
  const auto number_in = [](const json& flat, const std::string& key) {
    return flat.contains(key) && flat[key].is_number() ? flat[key].get<double>() : 0;  // omitted if 0
  };
  const json own = in_si.flatten(), other = expected.flatten();
  json keys = own;
  keys.update(other);
  for (const auto& [key, value] : keys.items()) {
    const double is = number_in(own, key), should = number_in(other, key);
    if (std::abs(is - should) <= 1e-9 * scale_of(key, should)) continue;
    std::string path = key.substr(1);
    std::ranges::replace(path, '/', '.');
    faults.push_back({joined(place, path),
                      format("is %.12g, but the card's \"material.parameters\" give %.12g", is, should),
                      "undo the change; another material: pastefit simulate CARD --set parameters.NAME=VALUE"});
  }
}

/// Input of `compare`: with the attraction in overlap, which may be that of the bridge.
json contact_in_full(Test test) {
  ContactModel& contact = specimen_of(test).contact;
  contact.cohesion_n = contact.cohesion_n.value_or(contact.bridge.c_n);
  return to_json(test);
}

Faults differing_forms(const Card& card) {
  const std::vector<double> values = values_of(card.material);
  Faults faults;
  Test any_kind;  // the contact laws follow from the grains
  specimen_of(any_kind).grains = card.material.grains;
  specimen_of(any_kind).contact = card.material.contact;
  const auto compare_test = [&](const Test& test, const char* part, const std::string& place, bool without_contact) {
    const Test by_parameters = with_contact_of(test, values);
    json own = contact_in_full(test), other = contact_in_full(by_parameters);
    if (without_contact) own.erase("contact"), other.erase("contact");
    compare(place, *part ? own[part] : own, *part ? other[part] : other, specimen_of(by_parameters).contact.bridge,
            faults);
    return own;
  };
  const json of_material = compare_test(any_kind, "contact", "material.contact", false);
  for (std::size_t i = 0; i < card.tests.size(); ++i) {
    const Test& test = card.tests[i].test;
    const bool compared = specimen_of(test).grains.radius_m == card.material.grains.radius_m &&
                          contact_in_full(test)["contact"] == of_material["contact"];
    compare_test(test, "", "tests[" + std::to_string(i) + "].test", compared);
  }
  return faults;
}

}  // namespace
}  // namespace card_fields

bool is_card(const json& document) {
  const auto format = document.is_object() ? document.value("format", json()) : json();
  return format.is_string() && format.get_ref<const std::string&>().starts_with(card_fields::prefix);
}

ordered_json to_json(const Card& card) {
  ordered_json out;
  OrderedObjectWriter writer(out);
  out["format"] = card_fields::format_of(kCardVersion);
  card_fields::describe_card(writer, card);
  return out;
}

Result<Card> card_from_json(const json& document) {
  Faults faults = card_fields::format_faults(document);
  if (!faults.empty()) return faults;
  json present = document;
  if (document["format"] == card_fields::format_of(5)) card_fields::translate_from_5(present);
  Card read;
  read.material.parameters = default_parameters();
  {
    ObjectReader reader(present, "", faults);
    reader.known("format");
    card_fields::describe_card(reader, read);
    card_fields::check_names(reader, read.tests);
  }
  for (CardTest& test : read.tests) {
    test.lab.source = stated_source(test.lab.source);
    for (CardReading& reading : test.readings)
      if (reading.simulated.count == 0) reading.simulated.count = static_cast<int>(read.confirmation.packings.size());
  }
  if (faults.empty()) faults = card_fields::differing_forms(read);
  if (!faults.empty()) return faults;
  return read;
}

ordered_json card_schema() {
  ObjectSchema schema(card_fields::format_of(kCardVersion));
  Card any;
  any.material.parameters = default_parameters();
  card_fields::describe_card(schema, any);
  return schema.document("pastefit material card",
                         "A calibrated material: its contact laws in SI units and in scale-free form, the simulated "
                         "and measured readings of its tests, and its provenance. The schema does not check that the "
                         "numbers agree with each other. The writer of the card must ensure this.");
}

Result<Card> read_card(const std::filesystem::path& file) {
  return read_file(file, card_from_json);
}

Result<std::string> readable_text(const Card& card) {
  std::string text = json_text(to_json(card));
  const auto read = card_from_json(json::parse(text, nullptr, false));
  if (read.ok()) return text;
  Faults faults = read.faults();
  for (Fault& fault : faults) fault.where = "the new card, " + fault.where;
  return faults;
}

Faults write_card(const std::filesystem::path& file, const Card& card) {
  const auto text = readable_text(card);
  return text.ok() ? write_atomically(file, text.value()) : text.faults();
}

}  // namespace pastefit
