#include <exception>

#include "calibrate/base/text.h"
#include "calibrate/python/module.h"

namespace pastefit::python {

namespace py = pybind11;

void refuse(Faults faults) {
  if (!faults.empty()) throw BadInput{std::move(faults)};
}

void add_faults(py::module_&) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const BadInput& bad) {
      py::list faults;
      for (const Fault& fault : bad.faults)
        faults.append(py::make_tuple(one_line(fault.where), one_line(fault.what), one_line(fault.remedy)));
      const py::object type = py::module_::import("pastefit.faults").attr("InputError");
      const py::object error = type(faults);
      PyErr_SetObject(type.ptr(), error.ptr());
    }
  });
}

}  // namespace pastefit::python
