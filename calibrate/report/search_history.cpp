#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/inference/response_model.h"
#include "calibrate/report/page_content.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

using nlohmann::ordered_json;

constexpr int kMapPoints = 41;  // equally spaced on each axis, without the recommended material

/// Index of the evaluation's test in the study; nothing if it has none, e.g. with coarse grains.
std::optional<std::size_t> asked_test(const Study& study, const std::string& program,
                                      const StoredEvaluation& evaluation) {
  for (std::size_t i = 0; i < study.tests.size(); ++i) {
    const std::string key = key_of(study, i, evaluation.values, evaluation.packing, program);
    if (key == evaluation.key) return i;
    const auto cutoff = cutoff_of(study, i);
    if (cutoff && key_of_ended(key, *cutoff) == evaluation.key) return i;
  }
  return std::nullopt;
}

/// Largest difference of a fitted reading over its tolerance; nothing without readings.
std::optional<double> error_of(const Study& study, std::size_t index, const Readings& readings) {
  const StudyTest& test = study.tests[index];
  std::optional<double> largest;
  for (std::size_t i = 0; i < test.lab.measurements.size(); ++i) {
    const Measurement& measured = test.lab.measurements[i];
    const auto value = readings.find(measured.reading);
    if (test.targets[i].weight <= 0 || !value || !std::isfinite(*value)) continue;
    largest = std::max(largest.value_or(0), std::abs(*value - measured.value) / tolerance_of(study, index, i));
  }
  return largest;
}

ordered_json numbers_of(const Readings& readings) {
  auto out = ordered_json::object();
  for (const Reading& reading : readings.all())
    if (std::isfinite(reading.value)) out[reading.name] = rounded(reading.value);
  return out;
}

/// Values of the reported parameters by name.
ordered_json values_told(const Findings& findings, const StoredEvaluation& evaluation) {
  auto out = ordered_json::object();
  const auto kinds = parameter_kinds();
  for (std::size_t i = 0; i < kinds.size() && i < evaluation.values.size(); ++i) {
    const bool told =
        findings.study ? findings.study->parameters[i].free : evaluation.values[i] != kinds[i].default_value;
    if (told) out[std::string(kinds[i].name)] = rounded(evaluation.values[i]);
  }
  return out;
}

/// Adds the evaluation's test, its misfit, and whether it confirmed the card.
void judge(const Findings& findings, const StoredEvaluation& evaluation, ordered_json& point) {
  const Study& study = *findings.study;
  const auto index = asked_test(study, findings.program, evaluation);
  if (!index) {
    point["other_grains"] = true;
    return;
  }
  if (!study.tests[*index].name.empty()) point["test"] = study.tests[*index].name;
  if (const auto error = evaluation.failure ? std::nullopt : error_of(study, *index, evaluation.readings))
    point["misfit"] = rounded(error_unit_of(study).of(*error));
  if (!findings.card) return;
  const auto& packings = findings.card->confirmation.packings;
  const bool confirming = std::ranges::find(packings, evaluation.packing) != packings.end();
  if (confirming && evaluation.values == values_of(findings.card->material)) point["confirmation"] = true;
}

/// Indices of the two free parameters that the readings determine best: leads of the best determined combination and of
/// the next one with another lead.
std::array<std::size_t, 2> directions_that_matter(const Inference& inference) {
  const std::size_t first = inference.combinations.front().lead;
  for (const Combination& combination : inference.combinations)
    if (combination.lead != first) return {first, combination.lead};
  return {first, first == 0 ? std::size_t{1} : std::size_t{0}};
}

/// Grid along a coordinate of the unit cube, including the recommended material. Otherwise it would be drawn in a
/// neighbouring cell, which may be out of reach where the dependence is steep.
std::vector<double> map_places(double recommended) {
  std::vector<double> out;
  for (int k = 0; k < kMapPoints; ++k) out.push_back(k / (kMapPoints - 1.0));
  out.push_back(recommended);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// The value that a sensitivity compares with the recommended one.
double changed(const Parameter& parameter, double value) {
  const double step = value == 0 ? 0.1 * (parameter.upper - parameter.lower) : 0.2 * std::abs(value);
  return value + step <= parameter.upper ? value + step : std::max(value - step, parameter.lower);
}

ordered_json axis_of(const Parameter& parameter, const std::vector<double>& places) {
  ordered_json out = parameter_json(parameter);
  auto& values = out["places"] = ordered_json::array();
  for (const double place : places) values.push_back(rounded(value_between(parameter, place), 8));
  return out;
}

}  // namespace

ordered_json search_history(const Findings& findings) {
  auto out = ordered_json::array();
  for (const StoredEvaluation& evaluation : findings.evaluations) {
    ordered_json point{{"number", out.size() + 1}, {"packing", evaluation.packing}};
    point["values"] = values_told(findings, evaluation);
    point["readings"] = numbers_of(evaluation.readings);
    if (evaluation.failure)
      point["failure"] = std::string(name_of(evaluation.failure->reason)) + ": " + evaluation.failure->message;
    if (evaluation.run.ended_early) point["ended_early"] = true;
    if (!evaluation.sketch.points.empty()) point["sketch"] = to_json(evaluation.sketch);
    if (findings.study) judge(findings, evaluation, point);
    out.push_back(std::move(point));
  }
  return out;
}

ordered_json sensitivities(const Findings& findings) {
  if (!findings.inference || !findings.evidence) return {};
  const TrainingData& evidence = *findings.evidence;
  const ResponseModel model(evidence);
  const UnitPoint from = point_of(*findings.card);
  auto out = ordered_json::array();
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    const Parameter& parameter = evidence.parameters[k];
    const auto axis = static_cast<Eigen::Index>(k);
    UnitPoint to = from;
    const double value = value_between(parameter, from[axis]), other = changed(parameter, value);
    to[axis] = unit_of(parameter, other);
    auto changes = ordered_json::object();
    for (std::size_t i = 0; i < evidence.readings.size(); ++i)
      if (const auto change = evidence.readings[i].measured ? model.change(i, from, to) : std::nullopt)
        changes[evidence.readings[i].name] = {rounded(change->mean), rounded(std::sqrt(change->variance), 2)};
    out.push_back({{"parameter", parameter.name},
                   {"from", rounded(value)},
                   {"to", rounded(other)},
                   {"changes", std::move(changes)}});
  }
  return out;
}

ordered_json misfit_map(const Findings& findings) {
  if (!findings.inference || !findings.evidence || findings.evidence->parameters.size() < 2) return {};
  const TrainingData& evidence = *findings.evidence;
  const ResponseModel model(evidence);
  const auto [x, y] = directions_that_matter(*findings.inference);
  const Parameter &along = evidence.parameters[x], &up = evidence.parameters[y];
  UnitPoint point = point_of(*findings.card);
  const auto columns = map_places(point[static_cast<Eigen::Index>(x)]);
  const auto rows = map_places(point[static_cast<Eigen::Index>(y)]);
  ordered_json out{{"x", axis_of(along, columns)}, {"y", axis_of(up, rows)}};
  auto& miss = out["miss"] = ordered_json::array();
  for (const double row : rows)
    for (const double column : columns) {
      point[static_cast<Eigen::Index>(x)] = column;
      point[static_cast<Eigen::Index>(y)] = row;
      miss.push_back(rounded(model.distance(point), 3));
    }
  auto& equivalent = out["equivalent"] = ordered_json::array();
  for (const EquivalentMaterial& one : findings.inference->family)
    equivalent.push_back({rounded(one.values.at(x)), rounded(one.values.at(y))});
  std::set<std::pair<double, double>> simulated;
  for (const UnitPoint& one : evidence.points)
    simulated.emplace(rounded(value_between(along, one[static_cast<Eigen::Index>(x)])),
                      rounded(value_between(up, one[static_cast<Eigen::Index>(y)])));
  auto& places = out["simulated"] = ordered_json::array();
  for (const auto& [first, second] : simulated) places.push_back({first, second});
  return out;
}

}  // namespace pastefit
