#include "calibrate/card/card.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/card/card_versions.h"
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
  out["standard_error"] =
      packings == 0 ? 0 : observable.simulated_standard_deviation / std::sqrt(static_cast<double>(packings));
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

/// What the fit was made for; a use far from it is an extrapolation.
ordered_json conditions_to_json(const Card& card) {
  const auto& grains = specimen_of(card.test).grains;
  const bool mono = grains.distribution == SizeDistribution::mono;
  ordered_json out;
  out["grain_radius_m"] = {mono ? grains.radius_m : grains.smallest_m, mono ? grains.radius_m : grains.largest_m};
  out.update(conditions_of(card.test));
  for (const auto& observable : card.observables)
    if (observable.measured && observable.weight > 0) out["fitted"][observable.name] = *observable.measured;
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

ordered_json further_to_json(const CardTest& test, std::size_t packings) {
  ordered_json out{{"name", test.name},
                   {"hold_out", test.hold_out},
                   {"lab_file", test.lab_file},
                   {"lab_hash", test.lab_hash},
                   {"lab", provenance_to_json(test.lab)},
                   {"test", to_json(test.test)},
                   {"observables", observables_to_json(test.observables, packings)}};
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
}

ordered_json rebaseline_to_json(const Rebaseline& change) {
  ordered_json out{{"why", change.why},
                   {"program_before", change.program_before},
                   {"program_after", change.program_after},
                   {"moved", ordered_json::object()}};
  for (const auto& moved : change.moved)
    out["moved"][moved.observable] = {{"before", moved.before}, {"after", moved.after}};
  return out;
}

ordered_json rescaling_to_json(const Rescaling& step) {
  ordered_json out{{"from_radius_m", step.from_radius_m}, {"bias", ordered_json::object()}};
  for (const auto& bias : step.bias)
    out["bias"][bias.observable] = {
        {"before", bias.before}, {"after", bias.after}, {"standard_error", bias.standard_error}};
  return out;
}

}  // namespace

std::vector<TestOfCard> tests_of(Card& card) {
  std::vector<TestOfCard> tests{{"", true, card.test, card.observables, card.baseline}};
  for (auto& test : card.further)
    tests.push_back({test.name + ": ", !test.hold_out, test.test, test.observables, test.baseline});
  return tests;
}

MisfitUnit misfit_unit_of(const Card& card) {
  std::vector<std::pair<std::string_view, double>> fitted;
  const auto add = [&](const std::vector<CardObservable>& observables) {
    for (const auto& one : observables)
      if (one.measured && one.weight > 0) fitted.emplace_back(one.name, one.tolerance);
  };
  add(card.observables);
  for (const auto& test : card.further)
    if (!test.hold_out) add(test.observables);
  return misfit_unit_of(fitted);
}

ordered_json to_json(const Card& card) {
  ordered_json out;
  out["format"] = "pastefit-card-" + std::to_string(kCardVersion);
  out["title"] = card.title;
  out["material"] = {{"bulk_density_kg_m3", specimen_of(card.test).bulk_density_kg_m3},
                     {"grain_density_kg_m3", nullptr}};
  if (card.grain_density_kg_m3) out["material"]["grain_density_kg_m3"] = *card.grain_density_kg_m3;
  out["conditions"] = conditions_to_json(card);
  out["test"] = to_json(card.test);
  out["parameters"] = ordered_json::object();
  out["free"] = ordered_json::object();
  for (const auto& parameter : card.parameters) {
    if (!has_parameter(specimen_of(card.test).contact, parameter.name)) continue;
    out["parameters"][parameter.name] = parameter.value;
    if (!parameter.free) continue;
    auto& bounds = out["free"][parameter.name] = {{"lower", parameter.lower}, {"upper", parameter.upper}};
    for (const auto& scale : scales)
      if (scale.value == parameter.scale) bounds["scale"] = scale.name;
    if (const auto& prior = parameter.prior)
      bounds["prior"] = {{"value", prior->value}, {"standard_deviation", prior->standard_deviation}};
  }
  const auto packings = card.confirmation.packings.size();
  out["observables"] = observables_to_json(card.observables, packings);
  if (!card.test_name.empty()) out["test_name"] = card.test_name;
  for (const auto& test : card.further) out["further_tests"].push_back(further_to_json(test, packings));
  out["confirmation"] = {{"packings", card.confirmation.packings},
                         {"fresh", card.confirmation.fresh},
                         {"misfit", card.confirmation.misfit},
                         {"meets_laboratory", card.confirmation.meets_laboratory}};
  const auto& search = card.search;
  out["search"] = {{"strategy", search.strategy},      {"status", search.status},
                   {"reason", search.reason},          {"seed", search.seed},
                   {"packings", search.packings},      {"budget", search.budget},
                   {"simulations", search.simulations}};
  out["search"]["failures"] = ordered_json::object();
  for (const auto& [reason, count] : search.failures) out["search"]["failures"][reason] = count;
  if (search.coarse_simulations > 0) out["search"]["coarse_simulations"] = search.coarse_simulations;
  const auto& provenance = card.provenance;
  out["provenance"] = {{"study_file", provenance.study_file},       {"study_hash", provenance.study_hash},
                       {"lab_file", provenance.lab_file},           {"lab_hash", provenance.lab_hash},
                       {"lab", provenance_to_json(provenance.lab)}, {"program", provenance.program}};
  add_inference(out, card.inference);
  out["baseline"] = baseline_to_json(card.baseline);
  for (const auto& change : card.rebaselined) out["rebaselined"].push_back(rebaseline_to_json(change));
  for (const auto& step : card.rescaled) out["rescaled"].push_back(rescaling_to_json(step));
  return out;
}

}  // namespace pastefit
