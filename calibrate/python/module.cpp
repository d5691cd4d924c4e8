#include "calibrate/python/module.h"

#include "calibrate/base/text.h"
#include "calibrate/store/program.h"

// What crosses between C++ and Python: positions and radii as views of memory, everything else as the JSON text that it
// has in files. The package pastefit (calibrate/python/pastefit) is what users see.
PYBIND11_MODULE(_core, module) {
  using namespace pastefit;
  python::add_faults(module);
  if (const Faults faults = obey_kernels_variable(); !faults.empty()) throw pybind11::import_error(message_of(faults));
  python::add_stop(module);
  python::add_study(module);
  python::add_simulation(module);
  python::add_tasks(module);
  python::add_calibration(module);
  python::add_search(module);
  python::add_cards(module);
  module.def("version", program_version);
  module.def("program_identity", program_identity);
}
