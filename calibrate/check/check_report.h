#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calibrate/check/check.h"

namespace pastefit {

/// Card file and its check. A card that cannot be read is `not_checked`, with the faults as reason.
struct CheckedFile {
  std::filesystem::path file;
  CardCheck check;
  double seconds = 0;  ///< wall time
};

/// Check as text: a table of readings, and the verdict with its reason.
std::string text_of(const CheckedFile& checked);

/// {"agree", "disagree", "not_checked", "cards": [...]}.
nlohmann::ordered_json to_json(const std::vector<CheckedFile>& checked);

/// JUnit's XML: one test case for each card; `disagrees` is a failure, `not_checked` an error.
std::string junit_of(const std::vector<CheckedFile>& checked);

}  // namespace pastefit
