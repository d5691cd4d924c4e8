#pragma once

#include <pybind11/pybind11.h>

#include <utility>

#include "core/result.h"

namespace pastefit::python {

/// Becomes one `pastefit.InputError` that holds all of them.
struct BadInput {
  Faults faults;
};

/// The value, or a `BadInput` with every fault.
template <class T>
T value_or_throw(Result<T> result) {
  if (!result.ok()) throw BadInput{result.faults()};
  return std::move(result).value();
}

/// Throws a `BadInput` if there is a fault.
void refuse(Faults faults);

void add_faults(pybind11::module_& module);

}  // namespace pastefit::python
