#include "calibrate/card/card_versions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "calibrate/base/json_document.h"
#include "calibrate/card/card.h"

namespace pastefit {

namespace {

using nlohmann::json;

constexpr std::string_view kPrefix = "pastefit-card-";

std::string format_of(int version) {
  return std::string(kPrefix) + std::to_string(version);
}

void from_1(json& card) {
  card["baseline"] = {{"program", ""}, {"machine", ""}, {"packings", json::array()}, {"readings", json::object()}};
}

/// The number with this key; nothing if the value is no object or has none. Such faults are named when the card is
/// read.
std::optional<double> number_in(const json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

void give_tolerances(json& test, double tolerance_mm) {
  const auto observables = test.is_object() ? test.find("observables") : test.end();
  if (observables == test.end() || !observables->is_object()) return;
  for (auto& [name, observable] : observables->items()) {
    if (!number_in(observable, "measured")) continue;
    const auto tolerance = is_length(name) ? std::optional(tolerance_mm) : number_in(observable, "standard_deviation");
    if (tolerance) observable["tolerance"] = *tolerance;
  }
}

void from_2(json& card) {
  const auto confirmation = card.find("confirmation");
  if (confirmation == card.end()) return;
  const auto tolerance_mm = number_in(*confirmation, "tolerance_mm"), misfit_mm = number_in(*confirmation, "misfit_mm");
  if (!misfit_mm || !(tolerance_mm > 0.0)) return;
  confirmation->erase("misfit_mm");
  confirmation->erase("tolerance_mm");
  (*confirmation)["misfit"] = *misfit_mm / *tolerance_mm;
  give_tolerances(card, *tolerance_mm);
  if (const auto further = card.find("further_tests"); further != card.end() && further->is_array())
    for (json& test : *further) give_tolerances(test, *tolerance_mm);
}

/// Moves a member to another object, if it is there.
void carry(json& from, const char* key, json& to, const char* as) {
  const auto found = from.find(key);
  if (found == from.end()) return;
  to[as] = std::move(*found);
  from.erase(found);
}

void from_3(json& card) {
  json material = json::object(), first = json::object();
  if (const auto given = card.find("material"); given != card.end() && given->is_object()) material = std::move(*given);
  for (const char* key : {"parameters", "free"}) carry(card, key, material, key);
  carry(card, "test_name", first, "name");
  for (const char* key : {"test", "observables", "baseline"}) carry(card, key, first, key);
  if (const auto provenance = card.find("provenance"); provenance != card.end() && provenance->is_object())
    for (const char* key : {"lab_file", "lab_hash", "lab"}) carry(*provenance, key, first, key);

  json tests = json::array({std::move(first)});
  if (const auto further = card.find("further_tests"); further != card.end() && further->is_array())
    for (json& test : *further) tests.push_back(std::move(test));
  for (json& entry : tests) {
    const auto test = entry.is_object() ? entry.find("test") : entry.end();
    if (test == entry.end() || !test->is_object()) continue;
    for (const char* key : {"bulk_density_kg_m3", "grains", "contact"}) {
      if (&entry == &tests[0]) material[key] = test->value(key, json());
      if (test->value(key, json()) == material[key]) test->erase(key);
    }
  }
  card["material"] = std::move(material);
  card["tests"] = std::move(tests);
  card.erase("further_tests");
  card.erase("conditions");
}

/// The member as an object; nothing if there is none.
json* part_of(json& from, const char* key) {
  const auto found = from.is_object() ? from.find(key) : from.end();
  return found != from.end() && found->is_object() ? &*found : nullptr;
}

/// The bridge ends where its shells meet at most: what an offset did beyond that.
void bound_offset(json& holder, double reach, double radius_m) {
  json* const contact = part_of(holder, "contact");
  json* const bridge = contact ? part_of(*contact, "bridge") : nullptr;
  if (!bridge || bridge->value("shape", json()) == "none" || !number_in(*bridge, "offset_m")) return;
  if (bridge->value("formation", json()) == "touch" || bridge->at("offset_m").get<double>() > 0.5 * reach * radius_m)
    (*bridge)["offset_m"] = 0.5 * reach * radius_m;
}

bool is_touch(json& material) {
  json* const contact = part_of(material, "contact");
  json* const bridge = contact ? part_of(*contact, "bridge") : nullptr;
  return bridge && bridge->value("formation", json()) == "touch";
}

void from_4(json& card) {
  constexpr auto before = "offset_ratio", now = "formation_ratio", gap_key = "rupture_gap_ratio";
  json* const material = part_of(card, "material");
  json* const parameters = material ? part_of(*material, "parameters") : nullptr;
  if (!parameters) return;
  const double offset = number_in(*parameters, before).value_or(0.15);
  double gap = number_in(*parameters, gap_key).value_or(0.3);
  parameters->erase(before);
  if (is_touch(*material)) (*parameters)[gap_key] = gap = std::min(gap, 2 * offset);
  const auto ratio = [gap](double of_offset) { return gap > 0 ? std::min(1.0, 2 * of_offset / gap) : 1.0; };
  if (!is_touch(*material)) (*parameters)[now] = ratio(offset);

  const auto radius_of = [](json& holder) {
    json* const grains = part_of(holder, "grains");
    return grains ? number_in(*grains, "radius_m") : std::nullopt;
  };
  const double radius_m = radius_of(*material).value_or(0);
  bound_offset(*material, gap, radius_m);
  if (const auto tests = card.find("tests"); tests != card.end() && tests->is_array())
    for (json& entry : *tests)
      if (json* const test = part_of(entry, "test")) bound_offset(*test, gap, radius_of(*test).value_or(radius_m));

  const auto rename = [&](json* object) {
    if (!object || !object->contains(before)) return;
    if (!is_touch(*material)) (*object)[now] = std::move((*object)[before]);
    object->erase(before);
  };
  json* const free = part_of(*material, "free");
  json* const intervals = part_of(card, "intervals");
  for (json* bounds : {free, intervals ? part_of(*intervals, "parameters") : nullptr}) {
    rename(bounds);
    json* const own = bounds ? part_of(*bounds, now) : nullptr;
    for (const char* end : {"lower", "upper"})
      if (const auto bound = own ? number_in(*own, end) : std::nullopt) (*own)[end] = ratio(*bound);
    if (own) own->erase("prior");
    if (own && bounds == free && own->value("lower", json()) == own->value("upper", json())) (*own)["lower"] = 0;
  }
  rename(part_of(card, "not_identified"));
  if (json* const correlation = part_of(card, "correlation")) {
    rename(correlation);
    for (auto& [first, row] : correlation->items()) rename(row.is_object() ? &row : nullptr);
  }
}

/// The n-th step leads from version n + 1 to the next one.
constexpr std::array<void (*)(json&), kCardVersion - 1> kSteps{from_1, from_2, from_3, from_4};

/// The number after the prefix; 0 if it is none.
int version_of(const std::string& format) {
  int version = 0;
  const char* const end = format.data() + format.size();
  const auto [rest, error] = std::from_chars(format.data() + kPrefix.size(), end, version);
  return error == std::errc() && rest == end ? std::max(version, 0) : 0;
}

}  // namespace

bool is_card(const json& document) {
  const auto format = document.is_object() ? document.value("format", json()) : json();
  return format.is_string() && format.get_ref<const std::string&>().starts_with(kPrefix);
}

Result<json> upgraded_card(json document) {
  Faults faults;
  if (!is_card(document)) {
    has_format(document, format_of(kCardVersion), faults);
    return faults;
  }
  const auto format = document["format"].get<std::string>();
  const int version = version_of(format);
  if (version < 1 || version > kCardVersion)
    return Fault{"format",
                 "is \"" + format + "\", but this program knows cards up to version " + std::to_string(kCardVersion),
                 "use the version of pastefit that wrote the card, or a newer one"};
  for (int step = version; step < kCardVersion; ++step) kSteps[static_cast<std::size_t>(step - 1)](document);
  document["format"] = format_of(kCardVersion);
  return document;
}

}  // namespace pastefit
