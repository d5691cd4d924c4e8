#include "calibrate/search/calibration.h"

namespace pastefit {

std::string_view name_of(CalibrationStatus status) {
  switch (status) {
    case CalibrationStatus::confirmed:
      return "confirmed";
    case CalibrationStatus::unconfirmed:
      return "unconfirmed";
    case CalibrationStatus::out_of_reach:
      return "out_of_reach";
    case CalibrationStatus::stopped:
      return "stopped";
    case CalibrationStatus::failed:
      return "failed";
  }
  return "unknown";
}

}  // namespace pastefit
