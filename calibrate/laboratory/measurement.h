#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// Measured reading of a test: mean and standard deviation of its repeats.
struct Measurement {
  std::string reading;            ///< key of the reading, e.g. "step1.height_mm"
  double value = 0;               ///< mean, in the unit of the key
  double standard_deviation = 0;  ///< of a single reading, in the unit of the key
  int repeats = 1;
};

/// Meaning of a reading by its key in laboratory files (reading_words.cpp); empty if unknown.
std::string_view meaning_of_reading(std::string_view key);

/// Result of checking all readings of a test together.
struct ReadingCheck {
  std::vector<std::string> doubts;  ///< possible mistakes, one sentence each, without a full stop
  std::vector<std::string> notes;   ///< the same of what is usual, e.g. the shape of the heap
  Faults faults;                    ///< contradictions between readings, or with the apparatus, beyond their deviations

  std::vector<std::string> remarks() const {
    std::vector<std::string> all = doubts;
    all.insert(all.end(), notes.begin(), notes.end());
    return all;
  }
};

}  // namespace pastefit
