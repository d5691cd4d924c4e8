#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// What a laboratory read off one test: mean and standard deviation of its repeats.
struct Measurement {
  std::string reading;            ///< key of the reading, e.g. "step1.height_mm"
  double value = 0;               ///< mean, in the unit of the key
  double standard_deviation = 0;  ///< of one reading, in the unit of the key
  int repeats = 1;
};

/// What a kind of test has to say of its readings, taken together.
struct ReadingCheck {
  std::vector<std::string> notes;  ///< what a person should know of them: a sentence each, without a full stop
  Faults faults;                   ///< readings that contradict each other, or the apparatus, beyond all noise
};

}  // namespace pastefit
