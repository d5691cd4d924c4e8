#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "calibrate/base/json_reader.h"
#include "calibrate/card/card.h"
#include "calibrate/card/card_changes.h"
#include "calibrate/card/card_format.h"
#include "calibrate/card/entries.h"
#include "calibrate/card/material_json.h"
#include "calibrate/card/two_forms.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

using nlohmann::json;

constexpr Range kAny;
constexpr Range kNotNegative{0};
constexpr Range kPositive{0, largest_quantity, true};
constexpr auto kRequired = Need::required;
constexpr auto kOptional = Need::optional;

CardObservable read_observable(ObjectReader& reader, const Range& range, std::string name) {
  CardObservable out;
  out.name = std::move(name);
  double derived = 0;
  reader.number("simulated", out.simulated, range, kRequired);
  reader.number("simulated_standard_deviation", out.simulated_standard_deviation, kNotNegative, kRequired);
  out.packings = 0;  // all of the confirmation's, unless it says so
  reader.integer("packings", out.packings, 1, 1'000'000, Need::optional);
  reader.number("standard_error", derived, kNotNegative, Need::optional);
  reader.nullable_number("measured", out.measured, range, kRequired);
  const auto need = out.measured ? Need::required : Need::optional;
  reader.number("standard_deviation", out.standard_deviation, kNotNegative, need);
  reader.integer("repeats", out.repeats, 0, 1'000'000, need);
  reader.number("weight", out.weight, kNotNegative, need);
  reader.number("tolerance", out.tolerance, kPositive, need);
  reader.number("difference", derived, kAny, Need::optional);
  if (double band = 0; reader.number("band", band, kNotNegative, Need::optional)) out.band = band;
  return out;
}

/// What a simulation can read, in the test of a card. Heaps of coarse grains leave the range of a laboratory by some: a
/// spread begins at nothing, and everything may be half as large again. Any number for readings this program has not.
Range simulated_range(const std::string& name, const Test* test) {
  if (!test) return kAny;
  const auto kinds = reading_kinds(*test);
  const ReadingKind* kind = find_kind(kinds, name);
  if (!kind) return kAny;
  const auto [smallest, largest] = kind->possible;
  return {1.5 * std::min(smallest, 0.0), 1.5 * largest};
}

void read_observables(ObjectReader& card, const json& document, const Test* test, std::vector<CardObservable>& target) {
  card.object("observables", kRequired, [&](ObjectReader& observables) {
    for (const auto& [name, value] : document["observables"].items())
      observables.object(name, kRequired, [&, key = name](ObjectReader& observable) {
        target.push_back(read_observable(observable, simulated_range(key, test), key));
      });
  });
}

/// The part of an object; null if the object or the part is none.
json object_in(const json& object, const char* key) {
  const auto part = object.is_object() ? object.find(key) : object.end();
  return part != object.end() && part->is_object() ? *part : json();
}

/// A test with a reader of its own, which knows its fields; whether it could be read. What it does not say is the
/// material's, and so are the faults of that.
bool read_test_of_material(json document, const json& material, const std::string& place, Test& target,
                           Faults& faults) {
  std::set<std::string> taken;
  for (const std::string key : of_material)
    if (document.is_object() && !document.contains(key)) {
      taken.insert(key);
      if (material.contains(key)) document[key] = material[key];
    }
  const auto test = test_from_json(document);
  if (test.ok()) target = test.value();
  if (test.ok()) return true;
  for (const auto& fault : test.faults()) {
    if (!taken.contains(fault.where.substr(0, fault.where.find('.')))) {
      faults.push_back({fault.where.empty() ? place : joined(place, fault.where), fault.what, fault.remedy});
      continue;
    }
    const std::string where = joined("material", fault.where);
    if (material.is_object() && std::ranges::find(faults, where, &Fault::where) == faults.end())
      faults.push_back({where, fault.what, fault.remedy});
  }
  return false;
}

void read_lab_provenance(ObjectReader& reader, Provenance& target) {
  reader.object("lab", kRequired, [&](ObjectReader& lab) {
    lab.text("source", target.source, kRequired);
    lab.text("licence", target.licence, kRequired);
    lab.text("notes", target.notes, kRequired);
    lab.flag("twin", target.twin, kRequired);
  });
}

void read_baseline(ObjectReader& reader, const json& document, const Test* test, Baseline& baseline) {
  reader.text("program", baseline.program, kRequired);
  reader.text("machine", baseline.machine, kRequired);
  std::vector<std::uint64_t> packings;
  reader.integers("packings", packings, kRequired);
  for (const auto packing : packings) baseline.runs.push_back({packing, {}});
  reader.object("readings", kRequired, [&](ObjectReader& readings) {
    for (const auto& [name, value] : document["readings"].items()) {
      std::vector<double> column;
      if (!readings.numbers(name, column, simulated_range(name, test), kRequired, packings.size(), packings.size()))
        continue;
      if (column.size() != packings.size()) continue;  // no packings, but readings: the length is a fault already
      for (std::size_t i = 0; i < column.size(); ++i) baseline.runs[i].observables.set(name, column[i]);
    }
  });
}

void read_card_test(ObjectReader& reader, const json& document, const json& material, CardTest& test) {
  reader.text("name", test.name, kOptional);
  reader.flag("hold_out", test.hold_out, kOptional);
  reader.text("lab_file", test.lab_file, kRequired);
  reader.text("lab_hash", test.lab_hash, kRequired);
  read_lab_provenance(reader, test.lab);
  reader.object("measured_yield_stress_pa", kOptional, [&](ObjectReader& measured) {
    Measurement& one = test.yield_stress.emplace();
    one.observable = "yield_stress_pa";
    measured.number("value", one.value, kPositive, kRequired);
    measured.number("standard_deviation", one.standard_deviation, kPositive, kRequired);
    measured.integer("repeats", one.repeats, 1, 1'000'000, kRequired);
  });
  reader.known("conditions");
  reader.known("yield_stress_pa");
  reader.known("test");
  const bool has_test =
      read_test_of_material(document.value("test", json()), material, reader.place("test"), test.test, reader.faults());
  const Test* ranges = has_test ? &test.test : nullptr;
  read_observables(reader, document, ranges, test.observables);
  if (bool within = false; reader.flag("within_noise", within, kOptional)) test.within_noise = within;
  reader.object("baseline", kOptional,
                [&](ObjectReader& baseline) { read_baseline(baseline, document["baseline"], ranges, test.baseline); });
}

void read_parameters(ObjectReader& material, std::vector<Parameter>& parameters) {
  for (const auto& kind : parameter_kinds()) {
    Parameter parameter;
    parameter.name = kind.name;
    parameter.value = kind.default_value;
    parameter.scale = kind.scale;
    parameters.push_back(parameter);
  }
  material.object("parameters", kRequired, [&](ObjectReader& reader) {
    for (auto& parameter : parameters) {
      const auto& kind = parameter_kinds()[static_cast<std::size_t>(&parameter - parameters.data())];
      reader.number(parameter.name, parameter.value, {kind.smallest, kind.largest}, kOptional);
    }
  });
  material.object("free", kRequired, [&](ObjectReader& reader) {
    for (auto& parameter : parameters)
      parameter.free = reader.object(parameter.name, Need::optional, [&](ObjectReader& bounds) {
        bounds.number("lower", parameter.lower, kAny, kRequired);
        bounds.number("upper", parameter.upper, kAny, kRequired);
        bounds.choice("scale", parameter.scale, scales, kRequired);
        bounds.object("prior", kOptional, [&](ObjectReader& prior) {
          auto& known = parameter.prior.emplace();
          prior.number("value", known.value, kAny, kRequired);
          prior.number("standard_deviation", known.standard_deviation, kNotNegative, kRequired);
        });
      });
  });
}

void read_card_material(ObjectReader& reader, Material& material) {
  describe_material(reader, material);
  reader.nullable_number("grain_density_kg_m3", material.grain_density_kg_m3, kNotNegative, kRequired);
  read_parameters(reader, material.parameters);
}

void read_search(ObjectReader& reader, SearchRecord& search) {
  constexpr int kMany = 1'000'000'000;
  reader.text("strategy", search.strategy, kRequired);
  reader.text("status", search.status, kRequired);
  reader.text("reason", search.reason, kRequired);
  reader.integer("seed", search.seed, kRequired);
  reader.integers("packings", search.packings, kRequired);
  reader.integer("budget", search.budget, 0, kMany, kRequired);
  reader.integer("simulations", search.simulations, 0, kMany, kRequired);
  reader.integer("coarse_simulations", search.coarse_simulations, 0, kMany, kOptional);
  reader.object("failures", kRequired, [&](ObjectReader& failures) {
    for (int reason = 0; reason <= static_cast<int>(FailureReason::stopped); ++reason) {
      const auto name = name_of(static_cast<FailureReason>(reason));
      int count = 0;
      if (failures.integer(name, count, 0, kMany, Need::optional)) search.failures[std::string(name)] = count;
    }
  });
}

void read_card_provenance(ObjectReader& reader, CardProvenance& provenance) {
  reader.text("study_file", provenance.study_file, kRequired);
  reader.text("study_hash", provenance.study_hash, kRequired);
  reader.text("program", provenance.program, kRequired);
}

void read_inference(ObjectReader& card, const json& document, CardInference& inference) {
  card.object("intervals", kOptional, [&](ObjectReader& intervals) {
    intervals.text("method", inference.method, kRequired);
    intervals.number("level", inference.level, {0, 1}, kRequired);
    intervals.object("parameters", kRequired, [&](ObjectReader& parameters) {
      each_entry(parameters, document["intervals"]["parameters"], [&](ObjectReader& entry, const std::string& name) {
        auto& interval = inference.intervals.emplace_back();
        interval.parameter = name;
        entry.number("lower", interval.lower, kAny, kRequired);
        entry.number("upper", interval.upper, kAny, kRequired);
      });
    });
  });
  card.object("correlation", kOptional, [&](ObjectReader& correlation) {
    each_entry(correlation, document["correlation"], [&](ObjectReader& row, const std::string& first) {
      for (const auto& [second, value] : document["correlation"][first].items()) {
        auto& pair = inference.correlations.emplace_back();
        pair.first = first;
        pair.second = second;
        row.number(second, pair.value, {-1, 1}, kRequired);
      }
    });
  });
  card.object("unstated_conditions", kOptional, [&](ObjectReader& conditions) {
    each_entry(conditions, document["unstated_conditions"], [&](ObjectReader& entry, const std::string& place) {
      ConditionEffect& effect = inference.conditions.emplace_back();
      effect.place = place;
      entry.number("assumed", effect.assumed, kAny, kRequired);
      entry.number("lower", effect.lower, kAny, kRequired);
      entry.number("upper", effect.upper, kAny, kRequired);
      entry.integer("packings", effect.packings, 0, 1000, kRequired);
      entry.object("readings", kRequired, [&](ObjectReader& readings) {
        each_entry(readings, document["unstated_conditions"][place]["readings"],
                   [&](ObjectReader& ends, const std::string& name) {
                     auto& reading = effect.readings.emplace_back();
                     reading.name = name;
                     ends.number("at_lower", reading.at_lower, kAny, kRequired);
                     ends.number("at_upper", reading.at_upper, kAny, kRequired);
                   });
      });
    });
  });
  card.object("not_identified", kOptional, [&](ObjectReader& unseen) {
    for (const auto& [name, reason] : document["not_identified"].items()) {
      auto& entry = inference.not_identified.emplace_back();
      entry.parameter = name;
      unseen.text(name, entry.reason, kRequired);
    }
  });
}

/// A card has a test; of several each has a name of its own.
void check_names(ObjectReader& card, const json& document, const std::vector<CardTest>& tests) {
  const auto list = document.find("tests");
  if (list == document.end() || (list->is_array() && list->empty()))
    card.fault("tests", "there are none", "at least one: [ {\"test\": { ... }, ... } ]");
  std::set<std::string> names;
  for (std::size_t i = 0; i < tests.size() && tests.size() > 1; ++i)
    if (tests[i].name.empty() || !names.insert(tests[i].name).second)
      card.fault("tests[" + std::to_string(i) + "].name", "is " + in_quotes(tests[i].name),
                 "of several tests each has a name of its own");
}

}  // namespace

Result<Card> card_from_json(const json& document) {
  Faults faults = card_format_faults(document);
  if (!faults.empty()) return faults;
  Card card;
  {
    ObjectReader reader(document, "", faults);
    reader.known("format");
    reader.text("title", card.title, kRequired);
    reader.object("material", kRequired, [&](ObjectReader& material) { read_card_material(material, card.material); });
    read_objects(reader, document, "tests", card.tests,
                 [material = object_in(document, "material")](ObjectReader& test, const json& entry, CardTest& target) {
                   read_card_test(test, entry, material, target);
                 });
    check_names(reader, document, card.tests);
    reader.object("confirmation", kRequired, [&](ObjectReader& confirmation) {
      confirmation.integers("packings", card.confirmation.packings, kRequired);
      confirmation.flag("fresh", card.confirmation.fresh, kRequired);
      confirmation.number("misfit", card.confirmation.misfit, kNotNegative, kRequired);
      confirmation.flag("meets_laboratory", card.confirmation.meets_laboratory, kRequired);
      confirmation.flag("refuted", card.confirmation.refuted, kOptional);
      confirmation.nullable_number("rejected_share_allowed", card.confirmation.rejected_share, {0, 1}, kOptional);
    });
    reader.object("search", kRequired, [&](ObjectReader& search) { read_search(search, card.search); });
    reader.object("provenance", kRequired,
                  [&](ObjectReader& provenance) { read_card_provenance(provenance, card.provenance); });
    read_inference(reader, document, card.inference);
    read_changes(reader, document, card);
  }
  for (CardTest& test : card.tests)
    for (CardObservable& observable : test.observables)
      if (observable.packings == 0) observable.packings = static_cast<int>(card.confirmation.packings.size());
  if (faults.empty()) faults = differing_forms(card);
  if (!faults.empty()) return faults;
  return card;
}

Result<Card> read_card(const std::filesystem::path& file) {
  Faults faults;
  const auto document = read_json(file, faults);
  if (!document) return faults;
  auto card = card_from_json(*document);
  if (card.ok() && faults.empty()) return card;
  if (!card.ok())
    for (auto& fault : in_file(card.faults(), file)) faults.push_back(std::move(fault));
  return faults;
}

}  // namespace pastefit
