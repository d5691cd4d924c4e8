#include "calibrate/python/answers.h"

#include <cmath>

#include "calibrate/base/text.h"

namespace pastefit::python {

std::optional<Failure> failure_of(const EngineAnswer& answer, std::span<const std::string> readings) {
  std::string why;
  if (answer.error) why = answer.error->empty() ? "The simulator failed." : *answer.error;
  for (const std::string& reading : readings) {
    if (!why.empty()) break;
    const double value = answer.readings.find(reading).value();
    if (!std::isfinite(value)) why = "The simulator gave no number for " + reading + ".";
    if (std::abs(value) > kLargestReading)
      why = format("The simulator gave %.3g for ", value) + reading + ", which is no reading.";
  }
  if (why.empty()) return std::nullopt;
  Failure failure;
  failure.reason = FailureReason::engine_failed;
  failure.message = why;
  return failure;
}

}  // namespace pastefit::python
