#include "calibrate/store/kernels_variable.h"

#include <cstdlib>

#include "calibrate/base/fault_text.h"
#include "core/step/kernel_choice.h"

namespace pastefit {

Faults obey_kernels_variable() {
  const char* const named = std::getenv("PASTEFIT_KERNELS");
  if (!named || !*named || use_kernels(named)) return {};
  return {{"PASTEFIT_KERNELS", "is " + in_quotes(named) + ", no set of kernels that this processor runs",
           "one of " + usable_kernels() + "; or leave it out, and the first of them is taken"}};
}

}  // namespace pastefit
