#include "core/result.h"

namespace pastefit {

std::string_view name_of(FailureReason reason) {
  switch (reason) {
    case FailureReason::non_finite:
      return "non_finite";
    case FailureReason::excessive_overlap:
      return "excessive_overlap";
    case FailureReason::grain_lost:
      return "grain_lost";
    case FailureReason::runaway_speed:
      return "runaway_speed";
    case FailureReason::energy_created:
      return "energy_created";
    case FailureReason::energy_lost:
      return "energy_lost";
    case FailureReason::step_collapse:
      return "step_collapse";
    case FailureReason::never_settled:
      return "never_settled";
    case FailureReason::packing_failed:
      return "packing_failed";
    case FailureReason::fell_apart:
      return "fell_apart";
    case FailureReason::step_limit:
      return "step_limit";
    case FailureReason::engine_failed:
      return "engine_failed";
    case FailureReason::stopped:
      return "stopped";
  }
  return "unknown";
}

}  // namespace pastefit
