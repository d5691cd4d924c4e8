#include "calibrate/card/card_changes.h"

#include <array>
#include <nlohmann/json.hpp>

#include "calibrate/card/entries.h"

namespace pastefit {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

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

ordered_json further_confirmation_to_json(const FurtherConfirmation& one) {
  ordered_json out{{"engine", one.engine}, {"program", one.program}};
  if (!one.test.empty()) out["test"] = one.test;
  out["radius_m"] = one.radius_m;
  out["packings"] = one.packings;
  out["accepted"] = one.accepted;
  out["ranks"] = one.ranks;
  out["wall_s"] = one.wall_s;
  out["core_s"] = one.core_s;
  if (one.misfit) out["misfit"] = *one.misfit;
  out["meets_laboratory"] = one.meets_laboratory;
  out["readings"] = ordered_json::object();
  for (const auto& reading : one.readings) {
    ordered_json& row = out["readings"][reading.observable];
    row = {{"card", reading.card},
           {"simulated", reading.simulated},
           {"simulated_standard_deviation", reading.simulated_standard_deviation},
           {"bias", reading.bias()}};
    if (reading.standard_error) row["standard_error"] = *reading.standard_error;
  }
  return out;
}

void read_rebaseline(ObjectReader& reader, const json& document, Rebaseline& change) {
  reader.text("why", change.why, Need::required);
  reader.text("program_before", change.program_before, Need::required);
  reader.text("program_after", change.program_after, Need::required);
  reader.object("moved", Need::required, [&](ObjectReader& readings) {
    each_entry(readings, document["moved"], [&](ObjectReader& entry, const std::string& name) {
      auto& moved = change.moved.emplace_back();
      moved.observable = name;
      entry.number("before", moved.before, Range{}, Need::required);
      entry.number("after", moved.after, Range{}, Need::required);
    });
  });
}

void read_rescaling(ObjectReader& reader, const json& document, Rescaling& step) {
  reader.number("from_radius_m", step.from_radius_m, {0, 1, true}, Need::required);
  reader.object("bias", Need::required, [&](ObjectReader& readings) {
    each_entry(readings, document["bias"], [&](ObjectReader& entry, const std::string& name) {
      auto& bias = step.bias.emplace_back();
      bias.observable = name;
      entry.number("before", bias.before, Range{}, Need::required);
      entry.number("after", bias.after, Range{}, Need::required);
      entry.number("standard_error", bias.standard_error, Range{0}, Need::required);
    });
  });
}

void read_further_confirmation(ObjectReader& reader, const json& document, FurtherConfirmation& one) {
  constexpr int kMany = 1'000'000;
  reader.text("engine", one.engine, Need::required);
  reader.text("program", one.program, Need::required);
  reader.text("test", one.test, Need::optional);
  reader.number("radius_m", one.radius_m, {0, 1, true}, Need::required);
  reader.integers("packings", one.packings, Need::required);
  reader.integer("accepted", one.accepted, 1, kMany, Need::required);
  reader.integer("ranks", one.ranks, 1, kMany, Need::required);
  reader.number("wall_s", one.wall_s, Range{0}, Need::required);
  reader.number("core_s", one.core_s, Range{0}, Need::required);
  if (double misfit = 0; reader.number("misfit", misfit, Range{0}, Need::optional)) one.misfit = misfit;
  reader.flag("meets_laboratory", one.meets_laboratory, Need::required);
  reader.object("readings", Need::required, [&](ObjectReader& readings) {
    each_entry(readings, document["readings"], [&](ObjectReader& entry, const std::string& name) {
      auto& reading = one.readings.emplace_back();
      double derived = 0;
      reading.observable = name;
      entry.number("card", reading.card, Range{}, Need::required);
      entry.number("simulated", reading.simulated, Range{}, Need::required);
      entry.number("simulated_standard_deviation", reading.simulated_standard_deviation, Range{0}, Need::required);
      entry.number("bias", derived, Range{}, Need::optional);
      if (double error = 0; entry.number("standard_error", error, Range{0}, Need::optional))
        reading.standard_error = error;
    });
  });
}

void read_interpolation(ObjectReader& card, std::optional<Interpolation>& interpolated) {
  if (!card.has("interpolated")) return card.known("interpolated");
  card.object("interpolated", Need::optional, [&](ObjectReader& reader) {
    Interpolation& one = interpolated.emplace();
    reader.text("variable", one.variable, Need::required);
    reader.number("value", one.value, Range{}, Need::required);
    static constexpr std::array<Named<std::string_view>, 2> models{
        {{"linear", "linear"}, {"gaussian_process", "gaussian_process"}}};
    std::string_view model;
    if (reader.choice("model", model, models, Need::required)) one.model = model;
    reader.texts("studies", one.studies, Need::required);
  });
}

}  // namespace

void add_changes(ordered_json& out, const Card& card) {
  for (const auto& change : card.rebaselined) out["rebaselined"].push_back(rebaseline_to_json(change));
  for (const auto& step : card.rescaled) out["rescaled"].push_back(rescaling_to_json(step));
  for (const auto& one : card.further_confirmations)
    out["further_confirmations"].push_back(further_confirmation_to_json(one));
  if (const auto& one = card.interpolated)
    out["interpolated"] = {
        {"variable", one->variable}, {"value", one->value}, {"model", one->model}, {"studies", one->studies}};
}

void read_changes(ObjectReader& reader, const json& document, Card& card) {
  read_objects(reader, document, "rebaselined", card.rebaselined, read_rebaseline);
  read_objects(reader, document, "rescaled", card.rescaled, read_rescaling);
  read_objects(reader, document, "further_confirmations", card.further_confirmations, read_further_confirmation);
  read_interpolation(reader, card.interpolated);
}

}  // namespace pastefit
