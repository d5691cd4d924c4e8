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

ordered_json AskedSearch::suggest(std::size_t count) {
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
  return out;
}

Faults AskedSearch::faults_of(const EngineAnswer& answer, std::size_t place) const {
  const std::string where = "results[" + std::to_string(place) + "]";
  if (!asked_.contains(answer.candidate))
    return {{where, "answers candidate " + std::to_string(answer.candidate) + ", which nobody asked for",
             "the \"_id\" of a candidate that suggest() gave"}};
  Faults faults;
  if (answer.error) return faults;
  for (const std::string& reading : answers_->readings())
    if (!answer.readings.find(reading))
      faults.push_back({where, "has no \"" + reading + "\", which the laboratory measured",
                        "the number, NaN if there is none, or \"error\": why the simulation failed"});
  return faults;
}

namespace {

/// Result for one test: its readings under its own names; of a problem, the measured ones.
Outcome outcome_of(const Simulation& simulation, const EngineAnswer& answer, const std::vector<std::string>& measured) {
  Outcome outcome;
  if (answer.error) {
    outcome.failure.emplace().reason = FailureReason::engine_failed;
    outcome.failure->message = *answer.error;
  } else if (simulation.study) {
    const std::string before = reading_name(simulation.study->tests[simulation.test], "");
    for (const auto& [name, value] : answer.readings.all())
      if (name.starts_with(before)) outcome.readings.set(std::string_view(name).substr(before.size()), value);
  } else {
    for (const std::string& name : measured) outcome.readings.set(name, answer.readings.find(name).value());
  }
  return outcome;
}

}  // namespace

Faults AskedSearch::ingest(const std::vector<EngineAnswer>& answers) {
  Faults faults;
  for (std::size_t i = 0; i < answers.size(); ++i) append(faults, faults_of(answers[i], i));
  if (!faults.empty()) return faults;
  for (const EngineAnswer& answer : answers)
    for (const Simulation& one : asked_.at(answer.candidate)) {
      StoredEvaluation evaluation = answers_->unanswered(one);
      enter(evaluation, outcome_of(one, answer, answers_->readings()), std::nullopt);
      if (auto unstored = calibrator_.ingest(one, evaluation); !unstored.empty()) return unstored;
    }
  return {};
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

ordered_json AskedSearch::result() const {
  const CalibrationResult result = calibrator_.result();
  ordered_json out = result_json(result);
  const Calibration& found = result.search;
  if (result.card || found.best.point.size() == 0 || found.best.failed) return out;
  const Response& shown = shown_of(found);
  const auto& parameters = answers_->parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    out["parameters"][parameters[i].name] = value_between(parameters[i], shown.point[static_cast<Eigen::Index>(i)]);
  out["readings"] = readings_json(answers_->scoring(), shown, answers_->evidence(found.history).readings);
  if (result.inference) out["summary"] = describe(*result.inference);
  return out;
}

ordered_json AskedSearch::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_json(progress_);
}

Result<std::shared_ptr<AskedSearch>> search_of_study(std::shared_ptr<const Study> study, const std::string& study_file,
                                                     const std::string& file, const std::string& engine) {
  if (auto faults = validate(*study); !faults.empty()) return faults;
  auto opened = Store::open(file, {engine, inputs_of(*study)});
  if (!opened.ok()) return opened.faults();
  auto store = std::make_unique<Store>(std::move(opened).value());
  if (auto faults = strangers_in(*study, *store, file); !faults.empty()) return faults;
  auto answers = std::make_unique<StudyAnswers>(std::move(study), *store, study_file, Simulates::fitted_tests);
  return std::make_shared<AskedSearch>(std::move(store), std::move(answers), evaluations_json);
}

namespace {

/// [{"_id", "readings": {...}}, or {"_id", "error"}, ...]
std::vector<EngineAnswer> answers_from(const nlohmann::json& document) {
  std::vector<EngineAnswer> answers;
  for (const auto& given : document) {
    EngineAnswer answer;
    answer.candidate = given.at("_id").get<std::size_t>();
    if (given.contains("error")) answer.error = given.at("error").get<std::string>();
    if (given.contains("readings"))
      for (const auto& [name, value] : given.at("readings").items()) answer.readings.set(name, value.get<double>());
    answers.push_back(std::move(answer));
  }
  return answers;
}

}  // namespace

void add_search(py::module_& module) {
  module.def("largest_reading", [] { return kLargestReading; });
  const py::call_guard<py::gil_scoped_release> unlocked;
  py::class_<CustomProblem, std::shared_ptr<CustomProblem>>(module, "Problem")
      .def_static("from_json",
                  [](const std::string& text, const std::vector<std::string>& own_names) {
                    return value_or_throw(problem_from_json(parsed(text), own_names));
                  })
      .def_readonly("content", &CustomProblem::content)
      .def("description", [](const CustomProblem& problem) {
        return description_json(problem.title, problem.parameters, problem.readings, problem.search).dump();
      });
  py::class_<AskedSearch, std::shared_ptr<AskedSearch>>(module, "Search")
      .def_static("of_study",
                  [](std::shared_ptr<Study> study, const std::string& study_file, const std::string& file,
                     const std::string& engine) {
                    return value_or_throw(search_of_study(std::move(study), study_file, file, engine));
                  })
      .def_static("of_problem",
                  [](const CustomProblem& problem, const std::string& file, const std::string& engine) {
                    return value_or_throw(search_of_problem(problem, file, engine));
                  })
      .def(
          "suggest", [](AskedSearch& search, std::size_t count) { return search.suggest(count).dump(); }, unlocked)
      .def(
          "ingest",
          [](AskedSearch& search, const std::string& results) { refuse(search.ingest(answers_from(parsed(results)))); },
          unlocked)
      .def("stop", &AskedSearch::stop, unlocked)
      .def("finished", &AskedSearch::finished)
      .def(
          "result", [](AskedSearch& search) { return search.result().dump(); }, unlocked)
      .def("evaluations", [](const AskedSearch& search) { return search.evaluations().dump(); })
      .def("progress", [](const AskedSearch& search) { return search.progress().dump(); });
}

}  // namespace pastefit::python
