#include "calibrate/python/answers.h"

#include <cmath>

namespace pastefit::python {

std::optional<Failure> failure_of(const EngineAnswer& answer, std::span<const std::string> readings) {
  std::string why;
  if (answer.error) why = answer.error->empty() ? "The simulator failed." : *answer.error;
  for (const std::string& reading : readings)
    if (why.empty() && !std::isfinite(answer.readings.find(reading).value()))
      why = "The simulator gave no number for " + reading + ".";
  if (why.empty()) return std::nullopt;
  Failure failure;
  failure.reason = FailureReason::engine_failed;
  failure.message = why;
  return failure;
}

}  // namespace pastefit::python
