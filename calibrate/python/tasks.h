#pragma once

#include <pybind11/pybind11.h>

#include "calibrate/laboratory/engine.h"

namespace pastefit::python {

/// The engine whose simulations run wherever `ask` takes them: `ask(task, goes_on)` gets what `simulate_task` is to be
/// called with, and gives what it gave; nothing, if `goes_on()` became false and nobody waits any more.
/// `name`: of this engine among those that run at the same time.
Engine engine_of(pybind11::function ask, std::string name);

}  // namespace pastefit::python
