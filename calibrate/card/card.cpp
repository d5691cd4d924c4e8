#include "calibrate/card/card.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/base/fault_text.h"
#include "calibrate/base/object_writer.h"
#include "calibrate/card/card_changes.h"
#include "calibrate/card/card_format.h"
#include "calibrate/card/material_json.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json observable_to_json(const CardObservable& observable, std::size_t packings) {
  ordered_json out;
  out["simulated"] = observable.simulated;
  out["simulated_standard_deviation"] = observable.simulated_standard_deviation;
  if (static_cast<std::size_t>(observable.packings) != packings) out["packings"] = observable.packings;
  if (const auto error = standard_error(observable)) out["standard_error"] = *error;
  out["measured"] = nullptr;
  if (observable.measured) {
    out["measured"] = *observable.measured;
    out["standard_deviation"] = observable.standard_deviation;
    out["repeats"] = observable.repeats;
    out["weight"] = observable.weight;
    out["tolerance"] = observable.tolerance;
    out["difference"] = observable.simulated - *observable.measured;
  }
  if (observable.band) out["band"] = *observable.band;
  return out;
}

ordered_json observables_to_json(const std::vector<CardObservable>& observables, std::size_t packings) {
  auto out = ordered_json::object();
  for (const auto& observable : observables) out[observable.name] = observable_to_json(observable, packings);
  return out;
}

ordered_json provenance_to_json(const Provenance& lab) {
  return {{"source", lab.source}, {"licence", lab.licence}, {"notes", lab.notes}, {"twin", lab.twin}};
}

ordered_json baseline_to_json(const Baseline& baseline) {
  ordered_json out{{"program", baseline.program},
                   {"machine", baseline.machine},
                   {"packings", ordered_json::array()},
                   {"readings", ordered_json::object()}};
  for (const auto& run : baseline.runs) {
    out["packings"].push_back(run.packing);
    for (const auto& [name, value] : run.observables.all()) out["readings"][name].push_back(value);
  }
  return out;
}

json shared_part(const Material& material) {
  json out;
  ObjectWriter writer(out);
  describe_material(writer, material);
  return out;
}

ordered_json material_to_json(const Card& card) {
  const Material& material = card.material;
  ordered_json out{{"bulk_density_kg_m3", material.bulk_density_kg_m3}, {"grain_density_kg_m3", nullptr}};
  if (material.grain_density_kg_m3) out["grain_density_kg_m3"] = *material.grain_density_kg_m3;
  const json shared = shared_part(material);
  for (const char* key : of_material) out[key] = shared.at(key);
  out["parameters"] = ordered_json::object();
  out["free"] = ordered_json::object();
  for (const auto& parameter : material.parameters) {
    if (!has_parameter(card, parameter.name)) continue;
    out["parameters"][parameter.name] = parameter.value;
    if (!parameter.free) continue;
    auto& bounds = out["free"][parameter.name] = {{"lower", parameter.lower}, {"upper", parameter.upper}};
    for (const auto& scale : scales)
      if (scale.value == parameter.scale) bounds["scale"] = scale.name;
    if (const auto& prior = parameter.prior)
      bounds["prior"] = {{"value", prior->value}, {"standard_deviation", prior->standard_deviation}};
  }
  return out;
}

ordered_json test_to_json(const CardTest& test, const Material& material, std::size_t packings) {
  ordered_json out;
  if (!test.name.empty()) out["name"] = test.name;
  if (test.hold_out) out["hold_out"] = true;
  out["lab_file"] = test.lab_file;
  out["lab_hash"] = test.lab_hash;
  out["lab"] = provenance_to_json(test.lab);
  if (const auto& measured = test.yield_stress)
    out["measured_yield_stress_pa"] = {{"value", measured->value},
                                       {"standard_deviation", measured->standard_deviation},
                                       {"repeats", measured->repeats}};
  out["conditions"] = conditions_of(test.test);
  json of_test = to_json(test.test);
  const json shared = shared_part(material);
  for (const char* key : of_material)
    if (of_test.at(key) == shared.at(key)) of_test.erase(key);
  out["test"] = of_test;
  out["observables"] = observables_to_json(test.observables, packings);
  if (test.within_noise) out["within_noise"] = *test.within_noise;
  if (!test.baseline.runs.empty()) out["baseline"] = baseline_to_json(test.baseline);
  return out;
}

void add_inference(ordered_json& out, const CardInference& inference) {
  if (!inference.intervals.empty()) {
    out["intervals"] = {{"method", inference.method}, {"level", inference.level}};
    for (const auto& interval : inference.intervals)
      out["intervals"]["parameters"][interval.parameter] = {{"lower", interval.lower}, {"upper", interval.upper}};
  }
  for (const auto& pair : inference.correlations) out["correlation"][pair.first][pair.second] = pair.value;
  for (const auto& unseen : inference.not_identified) out["not_identified"][unseen.parameter] = unseen.reason;
  for (const ConditionEffect& one : inference.conditions) {
    ordered_json& effect = out["unstated_conditions"][one.place];
    effect = {{"assumed", one.assumed}, {"lower", one.lower}, {"upper", one.upper}, {"packings", one.packings}};
    effect["readings"] = ordered_json::object();
    for (const auto& reading : one.readings)
      effect["readings"][reading.name] = {{"at_lower", reading.at_lower}, {"at_upper", reading.at_upper}};
  }
}

}  // namespace

std::optional<double> standard_error(const CardObservable& observable) {
  if (observable.packings < 2) return std::nullopt;
  return observable.simulated_standard_deviation / std::sqrt(static_cast<double>(observable.packings));
}

std::vector<double> values_of(const Material& material) {
  std::vector<double> values;
  for (const auto& parameter : material.parameters) values.push_back(parameter.value);
  return values;
}

bool has_parameter(const Card& card, std::string_view name) {
  return has_parameter(card.material.contact, name) &&
         std::ranges::any_of(card.tests, [&](const CardTest& test) { return acts_in(test.test, name); });
}

std::string reading_name(const CardTest& test, std::string_view observable) {
  return (test.name.empty() ? "" : test.name + "/") + std::string(observable);
}

std::string heading_of(const CardTest& test) {
  return test.name.empty() ? "" : "Test " + test.name + ": ";
}

MisfitUnit misfit_unit_of(const Card& card) {
  std::vector<std::pair<std::string_view, double>> fitted;
  for (const auto& test : card.tests) {
    if (test.hold_out) continue;
    for (const auto& one : test.observables)
      if (one.measured && one.weight > 0) fitted.emplace_back(one.name, one.tolerance);
  }
  return misfit_unit_of(fitted);
}

std::string interpolation_in_words(const Interpolation& interpolation) {
  return "Interpolated, not confirmed: " + interpolation.variable + " " + shown(interpolation.value) + ", " +
         (interpolation.model == "linear" ? "linear" : "Gaussian process") + " between " +
         std::to_string(interpolation.studies.size()) + " materials";
}

std::string title_of(const Card& card) {
  return (card.interpolated ? interpolation_in_words(*card.interpolated) + ": " : "") + card.title;
}

ordered_json to_json(const Card& card) {
  ordered_json out;
  out["format"] = "pastefit-card-" + std::to_string(kCardVersion);
  out["title"] = card.title;
  out["material"] = material_to_json(card);
  out["tests"] = ordered_json::array();
  for (const auto& test : card.tests)
    out["tests"].push_back(test_to_json(test, card.material, card.confirmation.packings.size()));
  out["confirmation"] = {{"packings", card.confirmation.packings},
                         {"fresh", card.confirmation.fresh},
                         {"misfit", card.confirmation.misfit},
                         {"meets_laboratory", card.confirmation.meets_laboratory}};
  if (card.confirmation.refuted) out["confirmation"]["refuted"] = true;
  if (card.confirmation.rejected_share)
    out["confirmation"]["rejected_share_allowed"] = *card.confirmation.rejected_share;
  const auto& search = card.search;
  out["search"] = {{"strategy", search.strategy},      {"status", search.status},
                   {"reason", search.reason},          {"seed", search.seed},
                   {"packings", search.packings},      {"budget", search.budget},
                   {"simulations", search.simulations}};
  out["search"]["failures"] = ordered_json::object();
  for (const auto& [reason, count] : search.failures) out["search"]["failures"][reason] = count;
  if (search.coarse_simulations > 0) out["search"]["coarse_simulations"] = search.coarse_simulations;
  const auto& provenance = card.provenance;
  out["provenance"] = {
      {"study_file", provenance.study_file}, {"study_hash", provenance.study_hash}, {"program", provenance.program}};
  add_inference(out, card.inference);
  add_changes(out, card);
  return out;
}

}  // namespace pastefit
