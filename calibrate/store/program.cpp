#include "calibrate/store/program.h"

#include "calibrate/base/content_hash.h"
#include "engine_fingerprint.h"

namespace pastefit {

std::string program_version() {
  return PASTEFIT_VERSION;
}

std::string program_identity() {
  return "pastefit " + program_version() + " engine " +
         content_hash(std::string(PASTEFIT_ENGINE_SOURCES) + " " + __VERSION__);
}

}  // namespace pastefit
