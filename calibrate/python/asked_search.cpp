#include "calibrate/python/asked_search.h"

#include <pybind11/stl.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "calibrate/calibrate.h"
#include "calibrate/card/calibration_card.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/inference/description.h"
#include "calibrate/python/module.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit::python {

namespace py = pybind11;
using nlohmann::ordered_json;

AskedSearch::AskedSearch(std::unique_ptr<Store> store, std::unique_ptr<Answers> answers, Table table)
    : store_(std::move(store)),
      answers_(std::move(answers)),
      table_(std::move(table)),
      calibrator_(*answers_, [this](const Progress& progress) {
        const std::lock_guard lock(mutex_);
        progress_ = progress;
      }) {}

std::string AskedSearch::suggest(std::size_t count) {
  ordered_json out = ordered_json::array();
  for (const Simulation& one : calibrator_.suggest(count)) {
    auto& simulations = asked_[one.candidate];
    simulations.push_back(one);
    if (simulations.size() > 1) continue;
    ordered_json variables = ordered_json::object();
    const auto& parameters = answers_->parameters();
    for (std::size_t i = 0; i < parameters.size(); ++i)
      variables[parameters[i].name] = value_between(parameters[i], one.point[static_cast<Eigen::Index>(i)]);
    out.push_back({{"_id", one.candidate}, {"seed", one.packing}, {"variables", variables}, {"purpose", one.purpose}});
  }
  return out.dump();
}

Faults AskedSearch::faults_of(const EngineAnswer& answer, std::size_t place) const {
  const std::string where = "results[" + std::to_string(place) + "]";
  if (!asked_.contains(answer.candidate))
    return {{where, "answers candidate " + std::to_string(answer.candidate) + ", which nobody asked for",
             "the \"_id\" of a candidate that suggest() gave"}};
  Faults faults;
  if (answer.outcome.failure) return faults;
  for (const std::string& reading : answers_->readings())
    if (!answer.outcome.readings.find(reading))
      faults.push_back({where, "has no \"" + reading + "\", which the laboratory measured",
                        "the number, NaN if there is none, or \"error\": why the simulation failed"});
  return faults;
}

namespace {

EngineAnswer answer_in(const nlohmann::json& given) {
  EngineAnswer answer;
  answer.candidate = given.at("_id").get<std::size_t>();
  if (given.contains("error")) {
    answer.outcome.failure.emplace().reason = FailureReason::engine_failed;
    answer.outcome.failure->message = given.at("error").get<std::string>();
  }
  if (given.contains("readings"))
    for (const auto& [name, value] : given.at("readings").items())
      answer.outcome.readings.set(name, value.get<double>());
  return answer;
}

/// Result for one test: its readings under its own names; of a problem, the measured ones.
Outcome outcome_in(const Outcome& answer, const Simulation& simulation, const std::vector<std::string>& measured) {
  if (answer.failure) return answer;
  Outcome outcome;
  if (simulation.study) {
    const std::string before = reading_name(simulation.study->tests[simulation.test], "");
    for (const auto& [name, value] : answer.readings.all())
      if (name.starts_with(before)) outcome.readings.set(std::string_view(name).substr(before.size()), value);
  } else {
    for (const std::string& name : measured) outcome.readings.set(name, answer.readings.find(name).value());
  }
  return outcome;
}

}  // namespace

void AskedSearch::ingest(const std::string& answers) {
  std::vector<EngineAnswer> given;
  for (const auto& answer : nlohmann::json::parse(answers)) given.push_back(answer_in(answer));
  Faults faults;
  for (std::size_t i = 0; i < given.size(); ++i) append(faults, faults_of(given[i], i));
  refuse(std::move(faults));
  for (const EngineAnswer& answer : given)
    for (const Simulation& one : asked_.at(answer.candidate)) {
      StoredEvaluation evaluation = answers_->unanswered(one);
      enter(evaluation, outcome_in(answer.outcome, one, answers_->readings()), std::nullopt);
      refuse(calibrator_.ingest(one, evaluation));
    }
}

namespace {

/// Measured and simulated readings, as on a card.
ordered_json readings_json(const Scoring& scoring, const Response& shown,
                           const std::vector<ReadingTrainingData>& evidence) {
  ordered_json out = ordered_json::array();
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const double simulated = shown.readings[static_cast<Eigen::Index>(i)];
    out.push_back({{"name", evidence[i].name},
                   {"measured", *evidence[i].measured},
                   {"tolerance", scoring.tolerance(i)},
                   {"simulated", simulated},
                   {"standard_error", std::sqrt(squared_standard_error(shown, i))},
                   {"difference", simulated - *evidence[i].measured},
                   {"weight", evidence[i].weight}});
  }
  return out;
}

}  // namespace

std::string AskedSearch::result() const {
  const CalibrationResult result = calibrator_.result();
  ordered_json out = result_json(result);
  const Calibration& found = result.search;
  if (result.card || found.best.point.size() == 0 || found.best.failed) return out.dump();
  const Response& shown = shown_of(found);
  const auto& parameters = answers_->parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    out["parameters"][parameters[i].name] = value_between(parameters[i], shown.point[static_cast<Eigen::Index>(i)]);
  out["readings"] = readings_json(answers_->scoring(), shown, answers_->evidence(found.history).readings);
  if (result.inference) out["summary"] = describe(*result.inference);
  return out.dump();
}

std::string AskedSearch::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_json(progress_).dump();
}

std::shared_ptr<AskedSearch> search_of_study(std::shared_ptr<Study> study, const std::string& study_file,
                                             const std::string& file, const std::string& engine) {
  refuse(validate(*study));
  auto store = std::make_unique<Store>(value_or_throw(Store::open(file, {engine, inputs_of(*study)})));
  refuse(strangers_in(*study, *store, file));
  auto answers = std::make_unique<StudyAnswers>(std::move(study), *store, study_file, Simulates::fitted_tests);
  return std::make_shared<AskedSearch>(std::move(store), std::move(answers), evaluations_json);
}

void add_search(py::module_& module) {
  module.def("largest_reading", [] { return kLargestReading; });
  const py::call_guard<py::gil_scoped_release> unlocked;
  py::class_<CustomProblem>(module, "Problem")
      .def_static("from_json", problem_from_json)
      .def_readonly("content", &CustomProblem::content)
      .def("description", [](const CustomProblem& problem) {
        return description_json(problem.title, problem.parameters, problem.readings, problem.search).dump();
      });
  py::class_<AskedSearch, std::shared_ptr<AskedSearch>>(module, "Search")
      .def_static("of_study", search_of_study)
      .def_static("of_problem", search_of_problem)
      .def("suggest", &AskedSearch::suggest, unlocked)
      .def("ingest", &AskedSearch::ingest, unlocked)
      .def("stop", &AskedSearch::stop, unlocked)
      .def("finished", &AskedSearch::finished)
      .def("result", &AskedSearch::result, unlocked)
      .def("evaluations", &AskedSearch::evaluations)
      .def("progress", &AskedSearch::progress);
}

}  // namespace pastefit::python
