#include "calibrate/report/page_content.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/inference/description.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

using nlohmann::ordered_json;

/// Parameters of the material; of a search without results the free ones.
ordered_json parameters_of(const Findings& findings) {
  auto out = ordered_json::array();
  if (!findings.card) {
    for (const Parameter& parameter : findings.study->parameters)
      if (parameter.free) out.push_back(parameter_json(parameter));
    return out;
  }
  const Card& card = *findings.card;
  for (const Parameter& parameter : card.material.parameters) {
    if (!has_parameter(card, parameter.name)) continue;
    const auto kind = std::ranges::find(parameter_kinds(), parameter.name, &ParameterKind::name);
    ordered_json one = parameter_json(parameter);
    one["meaning"] = kind == parameter_kinds().end() ? "" : std::string(kind->meaning);
    one["value"] = parameter.value;
    const auto& known = card.inference;
    for (const auto& interval : known.intervals)
      if (interval.parameter == parameter.name) {
        const BoundEnds at_bounds = ends_at_bounds(interval, parameter);
        one["interval"] = {interval.lower, interval.upper};
        if (at_bounds.lower || at_bounds.upper) one["at_bounds"] = {at_bounds.lower, at_bounds.upper};
      }
    for (const auto& unseen : known.not_identified)
      if (unseen.parameter == parameter.name) one["not_identified"] = unseen.reason;
    out.push_back(std::move(one));
  }
  return out;
}

ordered_json page_readings(const CardTest& test) {
  auto out = ordered_json::array();
  for (const CardReading& one : test.readings) {
    ordered_json reading{{"name", one.name},
                         {"simulated", one.simulated.mean},
                         {"simulated_standard_deviation", one.simulated.standard_deviation}};
    if (const auto error = standard_error(one)) reading["standard_error"] = *error;
    reading["packings"] = ordered_json::array();
    for (const Baseline::Run& run : test.baseline.runs)
      if (const auto value = run.readings.find(one.name)) reading["packings"].push_back(*value);
    if (one.measured) {
      reading["measured"] = *one.measured;
      reading["standard_deviation"] = one.standard_deviation;
      reading["repeats"] = one.repeats;
      reading["weight"] = one.weight;
      reading["tolerance"] = one.tolerance;
    }
    out.push_back(std::move(reading));
  }
  return out;
}

ordered_json rounded_point(const DrawnPoint& point) {
  return {rounded(point[0]), rounded(point[1])};
}

std::string drawn_by(DrawnBy by) {
  constexpr std::array<const char*, 5> names{"laboratory", "simulation", "apparatus", "run", "rejected"};
  return names[static_cast<std::size_t>(by)];
}

ordered_json json_of_length(const DrawnLength& length) {
  return {{"reading", length.reading},
          {"by", drawn_by(length.by)},
          {"from", rounded_point(length.from)},
          {"to", rounded_point(length.to)},
          {"first", rounded_point(length.first)},
          {"last", rounded_point(length.last)},
          {"value", length.value},
          {"deviation", length.deviation}};
}

ordered_json json_of_drawing(const Drawing& drawing) {
  ordered_json out{{"name", drawing.name}, {"x", drawing.x}, {"y", drawing.y}, {"to_scale", drawing.to_scale}};
  for (const char* part : {"bands", "lines", "lengths"}) out[part] = ordered_json::array();
  for (const DrawnBand& band : drawing.bands) {
    auto points = ordered_json::array();
    for (const auto& [x, low, high] : band.points) points.push_back({rounded(x), rounded(low), rounded(high)});
    out["bands"].push_back({{"name", band.name}, {"points", std::move(points)}});
  }
  for (const DrawnLine& line : drawing.lines) {
    auto points = ordered_json::array();
    for (const DrawnPoint& point : line.points) points.push_back(rounded_point(point));
    out["lines"].push_back({{"name", line.name},
                            {"by", drawn_by(line.by)},
                            {"points", std::move(points)},
                            {"deviation", rounded(line.deviation)}});
    if (line.packing) out["lines"].back()["packing"] = *line.packing;
  }
  for (const DrawnLength& length : drawing.lengths) out["lengths"].push_back(json_of_length(length));
  return out;
}

/// Runs of the view with the readings on the card, and the card's other runs, so that means agree with the card.
std::vector<SeenRun> runs_drawn(const CardTest& test, const TestView& view) {
  std::vector<SeenRun> runs = view.runs;
  for (const auto& known : test.baseline.runs) {
    const auto seen = std::ranges::find(runs, known.packing, &SeenRun::packing);
    if (seen == runs.end())
      runs.push_back({known.packing, known.readings, {}, {}});
    else
      seen->readings = known.readings;
  }
  return runs;
}

/// Run shown by the film, and whether it is identical to the card's.
ordered_json run_shown(const CardTest& test, const TestView& view) {
  if (view.runs.empty()) return {};
  const SeenRun& shown = view.runs.front();
  ordered_json out{{"packing", shown.packing}, {"program", view.program}, {"same_as_card", false}};
  for (const auto& run : test.baseline.runs) {
    if (run.packing != shown.packing) continue;
    out["same_as_card"] = std::ranges::all_of(
        run.readings.all(), [&](const Reading& one) { return shown.readings.find(one.name) == one.value; });
  }
  return out;
}

ordered_json page_test(const Findings& findings, std::size_t index) {
  const Card& card = *findings.card;
  const CardTest& test = card.tests[index];
  ordered_json out{{"name", test.name},         {"kind", kind_of(test.test)},
                   {"hold_out", test.hold_out}, {"source", test.lab.source},
                   {"notes", test.lab.notes},   {"licence", test.lab.licence},
                   {"twin", test.lab.twin},     {"lab_file", test.lab_file},
                   {"lab_hash", test.lab_hash}, {"conditions", conditions_in_words(test.test)}};
  out["readings"] = page_readings(test);
  if (auto compared = yield_stresses_json(test); !compared.empty()) out["yield_stress"] = std::move(compared);
  if (const auto& measured = test.yield_stress)
    out["measured_yield_stress"] = {{"value", measured->value}, {"standard_deviation", measured->standard_deviation}};
  const std::string remarks = remarks_on(test);
  out["remarks"] = remarks.empty() ? "" : remarks + ".";
  out["drawings"] = ordered_json::array();
  if (index >= findings.views.size()) return out;
  const TestView& view = findings.views[index];
  for (const Drawing& drawing : drawings_of(test.test, runs_drawn(test, view), laboratory_measurements(test)))
    out["drawings"].push_back(json_of_drawing(drawing));
  if (!view.film.empty()) out["film"] = ordered_json::parse(view.film.index);
  out["run_shown"] = run_shown(test, view);
  return out;
}

ordered_json type_in_of(const Card& card) {
  auto groups = ordered_json::array();
  for (const TypeInGroup& group : type_in_table(card)) {
    auto rows = ordered_json::array();
    for (const TypeInRow& row : group.rows)
      rows.push_back(
          {{"quantity", row.quantity}, {"value", typed(row.value)}, {"unit", row.unit}, {"remark", row.remark}});
    groups.push_back({{"title", group.title}, {"rows", std::move(rows)}});
  }
  return groups;
}

ordered_json page_inference(const Inference& inference) {
  ordered_json out{{"words", what_is_determined(inference)}, {"simulations", inference.simulations}};
  for (std::size_t i = 0; i < inference.fitted.size(); ++i)
    out["noise"][inference.fitted[i]] = rounded(inference.noise[i]);
  for (const EquivalentMaterial& one : inference.family) {
    auto values = ordered_json::object(), readings = ordered_json::object();
    for (std::size_t i = 0; i < one.values.size(); ++i)
      values[inference.intervals[i].parameter.name] = rounded(one.values[i]);
    for (std::size_t i = 0; i < one.readings.size(); ++i) readings[inference.fitted[i]] = rounded(one.readings[i]);
    out["family"].push_back(
        {{"values", std::move(values)}, {"readings", std::move(readings)}, {"simulated", one.simulated}});
  }
  return out;
}

/// Measurements by name of the reading, "name/reading" for tests with a name.
ordered_json measured_in(const Study& study) {
  auto out = ordered_json::object();
  for (const StudyTest& test : study.tests)
    for (const Measurement& one : test.lab.measurements)
      out[(test.name.empty() ? "" : test.name + "/") + one.reading] = rounded(one.value);
  return out;
}

/// Measured lengths by name of the test: those of the last drawing that has any.
ordered_json lengths_measured_in(const Study& study) {
  auto out = ordered_json::object();
  for (const StudyTest& test : study.tests)
    for (const Drawing& drawing : drawings_of(test.lab.test, {}, test.lab.measurements)) {
      if (drawing.lengths.empty()) continue;
      auto& lengths = out[test.name] = ordered_json::array();
      for (const DrawnLength& length : drawing.lengths) lengths.push_back(json_of_length(length));
    }
  return out;
}

ordered_json search_of(const Findings& findings) {
  ordered_json out{
      {"program", findings.program}, {"measured", ordered_json::object()}, {"laboratory", ordered_json::object()}};
  double seconds = 0;
  for (const StoredEvaluation& one : findings.evaluations) seconds += one.wall_s;
  out["wall_s"] = seconds;
  if (findings.study) {
    const ErrorUnit unit = error_unit_of(*findings.study);
    out["error_unit"] = unit.name();
    out["misfit_asked"] = unit.of(1);
    out["measured"] = measured_in(*findings.study);
    out["laboratory"] = lengths_measured_in(*findings.study);
  }
  if (findings.card) {
    const SearchRecord& search = findings.card->search;
    out["strategy"] = search.strategy;
    out["reason"] = search.reason;
    out["budget"] = search.budget;
    out["seed"] = search.seed;
  }
  out["history"] = search_history(findings);
  out["map"] = misfit_map(findings);
  return out;
}

}  // namespace

ordered_json page_content(const Findings& findings, const std::string& command) {
  ordered_json out{{"format", "pastefit-page-1"}, {"command", command}, {"program", program_identity()}};
  out["missing"] = findings.missing;
  out["under_way"] = findings.under_way;
  if (findings.study) out["title"] = findings.study->title;
  if (findings.card) {
    const Card& card = *findings.card;
    out["verdict"] = {{"words", verdict_of(card)},
                      {"reservations", reservations_on(card)},
                      {"meets_laboratory", card.confirmation.meets_laboratory},
                      {"refuted", card.confirmation.refuted},
                      {"only_heaps_refute", only_heaps_refute(card)},
                      {"unconfirmed", cause_unconfirmed(card)},
                      {"misfit", card.confirmation.error},
                      {"fresh", card.confirmation.fresh},
                      {"packings", card.confirmation.packings}};
    out["type_in"] = type_in_of(card);
    out["damping"] = damping_law(card.material.contact.normal);
    out["interval_level"] = card.inference.level;
    out["radius_mm"] = 1e3 * card.material.grains.radius_m;
    out["tests"] = ordered_json::array();
    for (std::size_t i = 0; i < card.tests.size(); ++i) out["tests"].push_back(page_test(findings, i));
    out["law"] = law_curves(card, findings.inference);
    out["summary"] = summary_of(card);
    out["provenance"] = {{"study_file", card.provenance.study_file},
                         {"study_hash", card.provenance.study_hash},
                         {"program", card.provenance.program}};
  }
  if (findings.card || findings.study) out["parameters"] = parameters_of(findings);
  if (findings.inference) {
    out["inference"] = page_inference(*findings.inference);
    out["inference"]["sensitivities"] = sensitivities(findings);
  }
  out["search"] = search_of(findings);
  return out;
}

}  // namespace pastefit
