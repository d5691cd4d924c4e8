#include "calibrate/python/module.h"

#include <exception>
#include <memory>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/store/program.h"

namespace pastefit::python {

namespace {

namespace py = pybind11;

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

}  // namespace

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
  python::add_study(module);
  python::add_simulation(module);
  python::add_tasks(module);
  python::add_calibration(module);
  python::add_search(module);
  python::add_cards(module);
  module.def("version", program_version);
  module.def("program_identity", program_identity);
}
