#pragma once

#include "core/result.h"

namespace pastefit {

/// Runs with the kernels that the environment variable `PASTEFIT_KERNELS` names, if it is there and not empty. Error:
/// it names none that this processor runs.
Faults obey_kernels_variable();

}  // namespace pastefit
