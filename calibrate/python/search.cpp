#include <pybind11/stl.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/python/answers.h"
#include "calibrate/python/asked_search.h"
#include "calibrate/python/custom_problem.h"
#include "calibrate/python/module.h"
#include "calibrate/study/parameters.h"

namespace pastefit::python {

namespace py = pybind11;
using nlohmann::ordered_json;

namespace {

std::string candidates_json(const std::vector<Parameter>& parameters, const std::vector<Candidate>& candidates) {
  ordered_json out = ordered_json::array();
  for (const Candidate& one : candidates) {
    ordered_json variables = ordered_json::object();
    for (std::size_t i = 0; i < parameters.size(); ++i)
      variables[parameters[i].name] = value_between(parameters[i], one.point[static_cast<Eigen::Index>(i)]);
    out.push_back({{"_id", one.number}, {"seed", one.packing}, {"variables", variables}, {"purpose", one.purpose}});
  }
  return out.dump();
}

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
                    return std::make_shared<AskedSearch>(
                        value_or_throw(answers_to_study(std::move(study), study_file, file, engine)));
                  })
      .def_static("of_problem",
                  [](const CustomProblem& problem, const std::string& file, const std::string& engine) {
                    return std::make_shared<AskedSearch>(value_or_throw(answers_to_problem(problem, file, engine)));
                  })
      .def(
          "suggest",
          [](AskedSearch& search, std::size_t count) {
            return candidates_json(search.answers().parameters(), search.suggest(count));
          },
          unlocked)
      .def(
          "ingest",
          [](AskedSearch& search, const std::string& results) { refuse(search.ingest(answers_from(parsed(results)))); },
          unlocked)
      .def("stop", &AskedSearch::stop)
      .def("finished", &AskedSearch::finished)
      .def(
          "result", [](AskedSearch& search) { return search.result().dump(); }, unlocked)
      .def("evaluations", [](const AskedSearch& search) { return search.answers().evaluations().dump(); })
      .def("progress", [](const AskedSearch& search) {
        std::string phase;
        const Progress progress = search.progress(phase);
        return progress_json(progress, phase).dump();
      });
}

}  // namespace pastefit::python
