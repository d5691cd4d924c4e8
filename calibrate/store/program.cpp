#include "calibrate/store/program.h"

#include <cstdlib>

#include "calibrate/base/text.h"
#include "core/step/kernels.h"
#include "engine_fingerprint.h"

namespace pastefit {

std::string program_version() {
  return PASTEFIT_VERSION;
}

std::string program_identity() {
  return "pastefit " + program_version() + " engine " +
         content_hash(std::string(PASTEFIT_ENGINE_SOURCES) + " " + __VERSION__);
}

Faults obey_kernels_variable() {
  const char* const named = std::getenv("PASTEFIT_KERNELS");
  if (!named || !*named || use_kernels(named)) return {};
  return {{"PASTEFIT_KERNELS", "is " + in_quotes(named) + ", no set of kernels that this processor runs",
           "one of " + usable_kernels() + "; or leave it out, and the first of them is taken"}};
}

}  // namespace pastefit
