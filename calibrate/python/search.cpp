#include <pybind11/stl.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/python/asked_search.h"
#include "calibrate/python/custom_problem.h"
#include "calibrate/python/module.h"

namespace pastefit::python {

namespace py = pybind11;
using nlohmann::ordered_json;

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
