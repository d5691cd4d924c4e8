#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/refusal.h"
#include "calibrate/base/statistics.h"
#include "calibrate/base/text.h"
#include "calibrate/evaluate/study_scoring.h"
#include "calibrate/python/asked_search.h"
#include "calibrate/python/module.h"
#include "calibrate/search/strategy_state.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/schemas.h"

namespace pastefit::python {

namespace {

using nlohmann::json;

constexpr double kLargest = 1e12;

std::vector<Parameter> read_parameters(ObjectReader& document) {
  std::vector<Parameter> parameters;
  document.object(
      "parameters", Need::required,
      [&](ObjectReader& reader) {
        for (const std::string& name : reader.keys()) {
          Parameter& parameter = parameters.emplace_back();
          parameter.name = name;
          parameter.stated = true;
          reader.object(name, Need::required, [&](ObjectReader& one) {
            read_free(one, {-kLargest, kLargest}, parameter);
          });
        }
        if (parameters.empty())
          document.fault("parameters", "none is named", "{\"friction\": {\"free\": [0.05, 0.8]}}");
      },
      "{\"friction\": {\"free\": [0.05, 0.8]}}");
  return parameters;
}

StudyReading read_measurement(ObjectReader& reader, const std::string& name) {
  StudyReading reading;
  reading.name = reading.measurement.reading = name;
  reader.number("value", reading.measurement.value, {-kLargest, kLargest}, Need::required);
  reader.number("standard_deviation", reading.measurement.standard_deviation, {1 / kLargest, kLargest}, Need::required);
  reader.integer("repeats", reading.measurement.repeats, 1, 1'000'000, Need::optional);
  reading.tolerance = reading.measurement.standard_deviation;
  return reading;
}

std::vector<StudyReading> read_readings(ObjectReader& document) {
  std::vector<StudyReading> readings;
  const std::string example = "{\"angle_deg\": {\"value\": 32, \"standard_deviation\": 1}}";
  document.object(
      "measurements", Need::required,
      [&](ObjectReader& reader) {
        for (const std::string& name : reader.keys())
          reader.object(name, Need::required,
                        [&](ObjectReader& one) { readings.push_back(read_measurement(one, name)); });
        if (readings.empty()) document.fault("measurements", "there is none", example);
      },
      example);
  document.object("tolerances", Need::optional, [&](ObjectReader& reader) {
    for (StudyReading& one : readings) reader.number(one.name, one.tolerance, {1 / kLargest, kLargest}, Need::optional);
  });
  document.object("weights", Need::optional, [&](ObjectReader& reader) {
    for (StudyReading& one : readings) reader.number(one.name, one.weight, {0, 1e6}, Need::optional);
  });
  return readings;
}

/// Faults of duplicate names: candidates, answers and the table of evaluations use parameters and readings side by
/// side.
Faults clashing_names(const CustomProblem& problem, const std::vector<std::string>& own) {
  Faults faults;
  const auto check = [&](const std::string& place, const std::string& name) {
    if (name.empty()) faults.push_back({place + ".\"\"", "is not a name", "a name of at least one letter"});
    if (std::ranges::count(own, name) > 0)
      faults.push_back({place + "." + name, "is a key of every candidate, answer or evaluation", "another name"});
  };
  for (const Parameter& parameter : problem.parameters) check("parameters", parameter.name);
  for (const StudyReading& reading : problem.readings) {
    check("measurements", reading.name);
    if (std::ranges::count(problem.parameters, reading.name, &Parameter::name) > 0)
      faults.push_back({"measurements." + reading.name, "is the name of a parameter, too", "another name"});
  }
  return faults;
}

/// True if it has a coordinate for each parameter and, unless it failed, a number for each reading.
bool is_answer(const CustomProblem& problem, const StoredEvaluation& kept) {
  const auto is_there = [&](const StudyReading& reading) {
    return std::isfinite(kept.readings.find(reading.name).value_or(std::nan("")));
  };
  return kept.point.size() == problem.parameters.size() &&
         (kept.failure || std::ranges::all_of(problem.readings, is_there));
}

/// The answers to a problem: one simulation for each candidate, of no test.
class ProblemAnswers : public Answers {
 public:
  ProblemAnswers(CustomProblem problem, Store& store)
      : Answers(problem.parameters, problem.readings, store),
        problem_(std::move(problem)),
        scoring_(problem_.readings, problem_.parameters) {}

  const Scoring& scoring() const override { return scoring_; }
  const SearchOptions& options() const override { return problem_.search; }
  std::optional<Card> card(const Calibration&, const EvaluationCounts&) const override { return std::nullopt; }

  std::vector<Simulation> simulations_of(const Candidate& candidate) const override {
    return {{candidate.number, nullptr, 0, candidate.point, candidate.packing, false, candidate.purpose}};
  }

  StoredEvaluation unanswered(const Simulation& simulation) const override {
    StoredEvaluation out;
    out.point.assign(simulation.point.begin(), simulation.point.end());
    out.key = content_hash(json{{"point", out.point}, {"seed", simulation.packing}}.dump());
    out.values = default_values();
    out.packing = simulation.packing;
    return out;
  }

  std::optional<StoredEvaluation> find(const Simulation& simulation) const override {
    auto kept = store().find(unanswered(simulation).key);
    return kept && is_answer(problem_, *kept) ? std::move(kept) : std::nullopt;
  }

  std::optional<Failure> failure_of(const Simulation&, const StoredEvaluation& evaluation) const override {
    return evaluation.failure;
  }

  Evaluation evaluation_of(std::span<const Simulation> simulations,
                           std::span<const StoredEvaluation> evaluations) const override {
    const StoredEvaluation& kept = evaluations.front();
    Evaluation evaluation;
    evaluation.point = simulations.front().point;
    evaluation.packing = kept.packing;
    evaluation.failure = kept.failure;
    if (!kept.failure)
      for (const StudyReading& reading : problem_.readings)
        evaluation.readings.push_back(kept.readings.find(reading.name).value());
    return evaluation;
  }

  TrainingData evidence(std::span<const Response> history) const override {
    TrainingData data;
    data.parameters = problem_.parameters;
    std::vector<const Evaluation*> good;
    std::set<std::pair<std::vector<double>, std::uint64_t>> seen;
    for (const Response& response : history)
      for (const Evaluation& one : response.evaluations) {
        const bool cut_off = one.failure && one.failure->reason == FailureReason::stopped;
        if (cut_off || !seen.insert({{one.point.begin(), one.point.end()}, one.packing}).second) continue;
        (one.failure ? data.failed : data.points).push_back(one.point);
        if (!one.failure) good.push_back(&one);
      }
    for (std::size_t k = 0; k < problem_.readings.size(); ++k) {
      const StudyReading& reading = problem_.readings[k];
      ReadingTrainingData one;
      one.name = reading.name;
      one.measured = reading.measurement.value;
      one.deviation = reading.measurement.standard_deviation;
      one.repeats = reading.measurement.repeats;
      one.widening = widening(one.repeats);
      one.weight = reading.weight;
      one.simulated.resize(static_cast<Eigen::Index>(good.size()));
      for (std::size_t i = 0; i < good.size(); ++i) one.simulated[static_cast<Eigen::Index>(i)] = good[i]->readings[k];
      data.readings.push_back(std::move(one));
    }
    return data;
  }

 private:
  const CustomProblem problem_;
  const ReadingScoring scoring_;
};

nlohmann::ordered_json evaluations_of(const CustomProblem& problem, const Store& store) {
  auto out = nlohmann::ordered_json::array();
  for (const StoredEvaluation& one : store.all()) {
    if (!is_answer(problem, one)) continue;
    nlohmann::ordered_json parameters;
    for (std::size_t i = 0; i < problem.parameters.size(); ++i)
      parameters[problem.parameters[i].name] = value_between(problem.parameters[i], one.point.at(i));
    out.push_back(evaluation_json(out.size(), one, std::move(parameters)));
  }
  return out;
}

}  // namespace

CustomProblem problem_from_json(const std::string& text, const std::vector<std::string>& own) {
  const json document = json::parse(text);
  Faults faults;
  CustomProblem problem;
  problem.content = document.dump();
  if (!document.is_object()) refuse({{"", "is not an object", "{\"title\", \"parameters\", \"measurements\", ...}"}});
  {
    ObjectReader reader(document, "", faults);
    reader.text("title", problem.title, Need::required);
    problem.parameters = read_parameters(reader);
    problem.readings = read_readings(reader);
    read_search_options(reader, 1, problem.search);
  }
  append(faults, clashing_names(problem, own));
  if (faults.empty()) faults = validate(problem.search, static_cast<int>(problem.parameters.size()));
  refuse(std::move(faults));
  return problem;
}

std::shared_ptr<AskedSearch> search_of_problem(CustomProblem problem, const std::string& file,
                                               const std::string& engine) {
  json inputs = json::parse(problem.content);
  inputs.erase("title");
  if (inputs.contains("search")) inputs["search"].erase("budget_simulations");
  auto store = std::make_unique<Store>(value_or_throw(Store::open(file, {engine, json{{"problem", inputs}}.dump()})));
  if (store->size() > 0 && !store->changes().empty())
    refuse({{file, "holds the answers of another problem", "another file; nothing of it was changed"}});
  auto answers = std::make_unique<ProblemAnswers>(problem, *store);
  const auto table = [problem = std::move(problem)](const Store& of) { return evaluations_of(problem, of); };
  return std::make_shared<AskedSearch>(std::move(store), std::move(answers), table);
}

}  // namespace pastefit::python
