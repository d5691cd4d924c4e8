#include "calibrate/python/module.h"

#include <pybind11/stl.h>

#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/inference/description.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"

namespace pastefit::python {

namespace py = pybind11;
using nlohmann::ordered_json;

namespace {

/// Translates a `Refusal` into one `pastefit.InputError` with all faults.
void translate_refusals() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const Refusal& refusal) {
      py::list faults;
      for (const Fault& fault : refusal.faults)
        faults.append(py::make_tuple(one_line(fault.where), one_line(fault.what), one_line(fault.remedy)));
      const py::object type = py::module_::import("pastefit.faults").attr("InputError");
      const py::object error = type(faults);
      PyErr_SetObject(type.ptr(), error.ptr());
    }
  });
}

ordered_json reading_json(const StudyReading& reading) {
  return {{"name", reading.name},
          {"measured", reading.measurement.value},
          {"standard_deviation", reading.measurement.standard_deviation},
          {"repeats", reading.measurement.repeats},
          {"weight", reading.weight},
          {"tolerance", reading.tolerance}};
}

ordered_json interval_json(const ParameterInterval& interval) {
  return {{"parameter", interval.parameter.name},
          {"recommended", interval.recommended},
          {"lower", interval.lower.at},
          {"upper", interval.upper.at},
          {"lower_known", interval.lower.known},
          {"upper_known", interval.upper.known},
          {"bound_lower", interval.parameter.lower},
          {"bound_upper", interval.parameter.upper},
          {"uncertainty", interval.uncertainty}};
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

ordered_json result_json(const CalibrationResult& result) {
  ordered_json out{{"status", name_of(result.search.status)},
                   {"reason", result.search.reason},
                   {"simulated", result.counts.simulated},
                   {"known", result.counts.answered},
                   {"failures", ordered_json::object()},
                   {"card", nullptr},
                   {"summary", ""},
                   {"intervals", ordered_json::array()},
                   {"correlation", ordered_json::array()}};
  for (const auto& [reason, count] : result.counts.failures) out["failures"][std::string(name_of(reason))] = count;
  if (result.card) {
    out["card"] = to_json(*result.card);
    out["summary"] = summary_of(*result.card, result.inference ? describe(*result.inference) : "");
  }
  if (!result.inference) return out;
  for (const ParameterInterval& interval : result.inference->intervals)
    out["intervals"].push_back(interval_json(interval));
  out["correlation"] = result.inference->correlation;
  return out;
}

ordered_json evaluation_json(std::size_t number, const StoredEvaluation& one, ordered_json parameters) {
  return {{"number", number},
          {"packing", one.packing},
          {"parameters", std::move(parameters)},
          {"readings", to_json(one.readings)},
          {"failure", one.failure ? std::string(name_of(one.failure->reason)) : ""},
          {"message", one.failure ? one.failure->message : ""},
          {"ended_early", one.run.ended_early}};
}

ordered_json evaluations_json(const Store& store) {
  ordered_json out = ordered_json::array();
  for (const StoredEvaluation& one : store.all()) {
    ordered_json parameters = ordered_json::object();
    for (std::size_t i = 0; i < one.values.size(); ++i)
      parameters[std::string(parameter_kinds()[i].name)] = one.values[i];
    out.push_back(evaluation_json(out.size(), one, std::move(parameters)));
    out.back()["wall_s"] = one.wall_s;
  }
  return out;
}

ordered_json progress_json(const Progress& progress) {
  return {{"phase", progress.phase},
          {"simulations", progress.simulations},
          {"budget", progress.budget},
          {"best_miss", progress.best_error < 0 ? ordered_json() : ordered_json(progress.best_error)},
          {"note", progress.note}};
}

}  // namespace pastefit::python

// Positions and radii cross the interface as memory views, everything else as JSON text in the format of files. Users
// see the package pastefit (calibrate/python/pastefit).
PYBIND11_MODULE(_core, module) {
  using namespace pastefit;
  python::translate_refusals();
  if (const Faults faults = obey_kernels_variable(); !faults.empty()) throw pybind11::import_error(message_of(faults));
  pybind11::class_<python::Stop, std::shared_ptr<python::Stop>>(module, "Stop")
      .def(pybind11::init<>())
      .def("set", [](python::Stop& stop) { stop.asked = true; });
  pybind11::class_<Study, std::shared_ptr<Study>>(module, "Study")
      .def_static("load", [](const std::string& file) { return value_or_throw(read_study(file)); })
      .def_static("from_json",
                  [](const std::string& text, const std::string& file) {
                    return value_or_throw(study_from_json(nlohmann::json::parse(text), file));
                  })
      .def_readonly("content", &Study::content)
      .def("description", [](const Study& study) {
        return python::description_json(study.title, study.parameters, readings_of(study), study.search).dump();
      });
  python::add_simulation(module);
  python::add_tasks(module);
  python::add_calibration(module);
  python::add_search(module);
  python::add_cards(module);
  module.def("version", program_version);
  module.def("program_identity", program_identity);
}
