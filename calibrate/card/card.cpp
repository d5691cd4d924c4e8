#include "calibrate/card/card.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/study/json_reader.h"
#include "calibrate/study/names.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/slump_table_json.h"

namespace pastefit {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::string_view kFormat = "pastefit-card-1";
constexpr Range kAny;
constexpr Range kNotNegative{0};
constexpr auto kRequired = Need::required;

ordered_json observable_to_json(const CardObservable& observable, std::size_t packings) {
  ordered_json out;
  out["simulated"] = observable.simulated;
  out["simulated_standard_deviation"] = observable.simulated_standard_deviation;
  out["standard_error"] =
      packings == 0 ? 0 : observable.simulated_standard_deviation / std::sqrt(static_cast<double>(packings));
  out["measured"] = nullptr;
  if (observable.measured) {
    out["measured"] = *observable.measured;
    out["standard_deviation"] = observable.standard_deviation;
    out["repeats"] = observable.repeats;
    out["weight"] = observable.weight;
    out["difference"] = observable.simulated - *observable.measured;
  }
  return out;
}

CardObservable read_observable(ObjectReader& reader, std::string name) {
  CardObservable out;
  out.name = std::move(name);
  double derived = 0;
  reader.number("simulated", out.simulated, kAny, kRequired);
  reader.number("simulated_standard_deviation", out.simulated_standard_deviation, kNotNegative, kRequired);
  reader.number("standard_error", derived, kNotNegative, Need::optional);
  reader.nullable_number("measured", out.measured, kAny, kRequired);
  const auto need = out.measured ? Need::required : Need::optional;
  reader.number("standard_deviation", out.standard_deviation, kNotNegative, need);
  reader.integer("repeats", out.repeats, 0, 1'000'000, need);
  reader.number("weight", out.weight, kNotNegative, need);
  reader.number("difference", derived, kAny, Need::optional);
  return out;
}

void read_parameters(ObjectReader& card, std::vector<Parameter>& parameters) {
  for (const auto& kind : parameter_kinds()) {
    Parameter parameter;
    parameter.name = kind.name;
    parameter.scale = kind.scale;
    parameters.push_back(parameter);
  }
  card.object("parameters", kRequired, [&](ObjectReader& reader) {
    for (auto& parameter : parameters) {
      const auto& kind = parameter_kinds()[static_cast<std::size_t>(&parameter - parameters.data())];
      reader.number(parameter.name, parameter.value, {kind.smallest, kind.largest}, kRequired);
    }
  });
  card.object("free", kRequired, [&](ObjectReader& reader) {
    for (auto& parameter : parameters)
      parameter.free = reader.object(parameter.name, Need::optional, [&](ObjectReader& bounds) {
        bounds.number("lower", parameter.lower, kAny, kRequired);
        bounds.number("upper", parameter.upper, kAny, kRequired);
        bounds.choice("scale", parameter.scale, scales, kRequired);
      });
  });
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
  reader.object("failures", kRequired, [&](ObjectReader& failures) {
    for (int reason = 0; reason <= static_cast<int>(FailureReason::stopped); ++reason) {
      const auto name = name_of(static_cast<FailureReason>(reason));
      int count = 0;
      if (failures.integer(name, count, 0, kMany, Need::optional)) search.failures[std::string(name)] = count;
    }
  });
}

void read_provenance(ObjectReader& reader, CardProvenance& provenance) {
  reader.text("study_file", provenance.study_file, kRequired);
  reader.text("study_hash", provenance.study_hash, kRequired);
  reader.text("lab_file", provenance.lab_file, kRequired);
  reader.text("lab_hash", provenance.lab_hash, kRequired);
  reader.object("lab", kRequired, [&](ObjectReader& lab) {
    lab.text("source", provenance.lab.source, kRequired);
    lab.text("licence", provenance.lab.licence, kRequired);
    lab.text("notes", provenance.lab.notes, kRequired);
    lab.flag("twin", provenance.lab.twin, kRequired);
  });
  reader.text("program", provenance.program, kRequired);
}

}  // namespace

ordered_json to_json(const Card& card) {
  ordered_json out;
  out["format"] = kFormat;
  out["title"] = card.title;
  out["material"] = {{"bulk_density_kg_m3", card.test.bulk_density_kg_m3}, {"grain_density_kg_m3", nullptr}};
  if (card.grain_density_kg_m3) out["material"]["grain_density_kg_m3"] = *card.grain_density_kg_m3;
  out["test"] = to_json(card.test);
  out["parameters"] = ordered_json::object();
  out["free"] = ordered_json::object();
  for (const auto& parameter : card.parameters) {
    out["parameters"][parameter.name] = parameter.value;
    if (!parameter.free) continue;
    auto& bounds = out["free"][parameter.name] = {{"lower", parameter.lower}, {"upper", parameter.upper}};
    for (const auto& scale : scales)
      if (scale.value == parameter.scale) bounds["scale"] = scale.name;
  }
  out["observables"] = ordered_json::object();
  for (const auto& observable : card.observables)
    out["observables"][observable.name] = observable_to_json(observable, card.confirmation.packings.size());
  out["confirmation"] = {{"packings", card.confirmation.packings},
                         {"fresh", card.confirmation.fresh},
                         {"misfit_mm", card.confirmation.misfit_mm},
                         {"tolerance_mm", card.confirmation.tolerance_mm},
                         {"meets_laboratory", card.confirmation.meets_laboratory}};
  const auto& search = card.search;
  out["search"] = {{"strategy", search.strategy},      {"status", search.status},
                   {"reason", search.reason},          {"seed", search.seed},
                   {"packings", search.packings},      {"budget", search.budget},
                   {"simulations", search.simulations}};
  out["search"]["failures"] = ordered_json::object();
  for (const auto& [reason, count] : search.failures) out["search"]["failures"][reason] = count;
  const auto& provenance = card.provenance;
  out["provenance"] = {{"study_file", provenance.study_file},
                       {"study_hash", provenance.study_hash},
                       {"lab_file", provenance.lab_file},
                       {"lab_hash", provenance.lab_hash},
                       {"lab",
                        {{"source", provenance.lab.source},
                         {"licence", provenance.lab.licence},
                         {"notes", provenance.lab.notes},
                         {"twin", provenance.lab.twin}}},
                       {"program", provenance.program}};
  return out;
}

Result<Card> card_from_json(const json& document) {
  Card card;
  Faults faults;
  if (!has_format(document, kFormat, faults)) return faults;
  json rest = document;  // the test has a reader of its own
  rest.erase("test");
  const auto test = slump_table_from_json(document.value("test", json()));
  if (test.ok())
    card.test = test.value();
  else
    for (const auto& fault : test.faults())
      faults.push_back({fault.where.empty() ? "test" : "test." + fault.where, fault.what, fault.remedy});
  {
    ObjectReader reader(rest, "", faults);
    reader.known("format");
    reader.text("title", card.title, kRequired);
    double derived = 0;
    reader.object("material", kRequired, [&](ObjectReader& material) {
      material.number("bulk_density_kg_m3", derived, kNotNegative, Need::optional);
      material.nullable_number("grain_density_kg_m3", card.grain_density_kg_m3, kNotNegative, kRequired);
    });
    read_parameters(reader, card.parameters);
    reader.object("observables", kRequired, [&](ObjectReader& observables) {
      for (const auto& [name, value] : rest["observables"].items())
        observables.object(name, kRequired, [&, key = name](ObjectReader& observable) {
          card.observables.push_back(read_observable(observable, key));
        });
    });
    reader.object("confirmation", kRequired, [&](ObjectReader& confirmation) {
      confirmation.integers("packings", card.confirmation.packings, kRequired);
      confirmation.flag("fresh", card.confirmation.fresh, kRequired);
      confirmation.number("misfit_mm", card.confirmation.misfit_mm, kNotNegative, kRequired);
      confirmation.number("tolerance_mm", card.confirmation.tolerance_mm, kNotNegative, kRequired);
      confirmation.flag("meets_laboratory", card.confirmation.meets_laboratory, kRequired);
    });
    reader.object("search", kRequired, [&](ObjectReader& search) { read_search(search, card.search); });
    reader.object("provenance", kRequired,
                  [&](ObjectReader& provenance) { read_provenance(provenance, card.provenance); });
  }
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
