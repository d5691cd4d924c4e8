#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calibrate/check/check.h"

namespace pastefit {

/// A card file and its answer. A card that could not be read is `not_checked`, with the faults as reason.
struct CheckedFile {
  std::filesystem::path file;
  CardCheck check;
  double seconds = 0;  ///< of the wall clock
};

/// The answer for a card as a person reads it: a table of readings, and a sentence.
std::string text_of(const CheckedFile& checked);

/// {"agree", "disagree", "not_checked", "cards": [...]}.
nlohmann::ordered_json to_json(const std::vector<CheckedFile>& checked);

/// JUnit's XML: one test case for each card; `disagrees` is a failure, `not_checked` an error.
std::string junit_of(const std::vector<CheckedFile>& checked);

}  // namespace pastefit
