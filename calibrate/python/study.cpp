#include "calibrate/study/study.h"

#include <pybind11/stl.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/laboratory/names.h"
#include "calibrate/python/module.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit::python {

namespace py = pybind11;
using nlohmann::ordered_json;

namespace {

ordered_json reading_json(const StudyReading& reading) {
  return {{"name", reading.name},
          {"measured", reading.measurement.value},
          {"standard_deviation", reading.measurement.standard_deviation},
          {"repeats", reading.measurement.repeats},
          {"weight", reading.weight},
          {"tolerance", reading.tolerance}};
}

}  // namespace

ordered_json description_json(const std::string& title, const std::vector<Parameter>& parameters,
                              const std::vector<StudyReading>& readings, const SearchOptions& search) {
  ordered_json out{{"title", title}, {"parameters", ordered_json::array()}, {"readings", ordered_json::array()}};
  for (const Parameter& parameter : parameters)
    if (parameter.free || parameter.stated) out["parameters"].push_back(parameter_json(parameter));
  for (const StudyReading& reading : readings) out["readings"].push_back(reading_json(reading));
  out["budget_simulations"] = search.budget_simulations;
  out["screening"] = search.screening;
  return out;
}

void add_study(py::module_& module) {
  py::class_<Study, std::shared_ptr<Study>>(module, "Study")
      .def_static("load", [](const std::string& file) { return value_or_throw(read_study(file)); })
      .def_static("from_json",
                  [](const std::string& text, const std::string& file) {
                    return value_or_throw(study_from_json(nlohmann::json::parse(text), file));
                  })
      .def_readonly("content", &Study::content)
      .def("description", [](const Study& study) {
        return description_json(study.title, study.parameters, readings_of(study), study.search).dump();
      });
}

}  // namespace pastefit::python
