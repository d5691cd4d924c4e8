#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/python/faults.h"
#include "calibrate/python/module.h"
#include "calibrate/python/result_json.h"
#include "calibrate/python/stored_search.h"
#include "calibrate/study/parameters.h"

namespace pastefit::python {

namespace py = pybind11;
using nlohmann::ordered_json;

namespace {

std::string candidates_json(const Study& study, const std::vector<Candidate>& candidates) {
  ordered_json out = ordered_json::array();
  for (const Candidate& one : candidates) {
    const auto values = values_at(study, coordinates(one.point));
    ordered_json variables = ordered_json::object();
    for (std::size_t i = 0; i < values.size(); ++i)
      if (study.parameters[i].free) variables[study.parameters[i].name] = values[i];
    out.push_back({{"_id", one.number}, {"seed", one.packing}, {"variables", variables}, {"purpose", one.purpose}});
  }
  return out.dump();
}

/// [{"_id", "readings": {...}}, or {"_id", "error"}, ...]; null in place of a number: NaN.
std::vector<EngineAnswer> answers_from(const nlohmann::json& document) {
  std::vector<EngineAnswer> answers;
  for (const auto& given : document) {
    EngineAnswer answer;
    answer.candidate = given.at("_id").get<std::size_t>();
    if (given.contains("error")) answer.error = given.at("error").get<std::string>();
    if (given.contains("readings"))
      for (const auto& [name, value] : given.at("readings").items())
        answer.readings.set(name, value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>());
    answers.push_back(std::move(answer));
  }
  return answers;
}

/// A `StoredSearch` with what it needs to name its parameters.
struct SearchOfStudy {
  std::shared_ptr<Study> study;
  std::unique_ptr<StoredSearch> search;
};

}  // namespace

void add_search(py::module_& module) {
  const py::call_guard<py::gil_scoped_release> unlocked;
  py::class_<SearchOfStudy, std::shared_ptr<SearchOfStudy>>(module, "Search")
      .def(py::init([](std::shared_ptr<Study> study, const std::string& study_file, const std::string& file,
                       const std::string& engine) {
        auto search = value_or_throw(StoredSearch::open(study, study_file, file, engine));
        return std::make_shared<SearchOfStudy>(SearchOfStudy{std::move(study), std::move(search)});
      }))
      .def(
          "suggest",
          [](SearchOfStudy& of, std::size_t count) { return candidates_json(*of.study, of.search->suggest(count)); },
          unlocked)
      .def(
          "ingest",
          [](SearchOfStudy& of, const std::string& results) {
            refuse(of.search->ingest(answers_from(parsed(results))));
          },
          unlocked)
      .def("stop", [](SearchOfStudy& of) { of.search->stop(); })
      .def("finished", [](const SearchOfStudy& of) { return of.search->finished(); })
      .def(
          "result", [](SearchOfStudy& of) { return result_json(of.search->result()).dump(); }, unlocked)
      .def("evaluations", [](const SearchOfStudy& of) { return evaluations_json(of.search->store()).dump(); })
      .def("progress", [](const SearchOfStudy& of) {
        std::string phase;
        const Progress progress = of.search->progress(phase);
        return progress_json(progress, phase).dump();
      });
}

}  // namespace pastefit::python
