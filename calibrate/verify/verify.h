#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calibrate/verify/case.h"
#include "core/result.h"

namespace pastefit {

enum class CaseVerdict {
  pass,
  known,  ///< fails for a reason documented in its file
  fail
};

std::string_view name_of(CaseVerdict verdict);

/// Result of one check at one point of a case.
struct CheckRow {
  std::size_t check = 0;  ///< index in the case
  std::string point;      ///< label; empty if the case has only one
  std::string reading;
  double expected = 0, got = 0;
  double error = 0;  ///< relative or absolute as in the check; for a bound, the excess
  double tolerance = 0;
  bool absolute = false;
  bool bound = false;  ///< `expected` is an upper bound
  CaseVerdict verdict = CaseVerdict::fail;
  std::string note;  ///< reason for a known deviation, or for a failed run
};

/// Runs every point of a case. Rows: for each point, for each check. `point_done`: called after each point. Errors:
/// faults of the scene, and formulas that are not valid for it; then there are no rows.
Result<std::vector<CheckRow>> verify(const Case& test, const std::function<void()>& point_done = {});

/// Row with the largest error over its tolerance for each check of the case.
std::vector<CheckRow> worst_rows(const std::vector<CheckRow>& rows);

/// Case file with the results of its checks.
struct VerifiedCase {
  std::filesystem::path file;
  Case test;
  std::vector<CheckRow> rows;
};

/// Runs cases: names of shipped ones, or files; all shipped ones if `names` is empty. `begin`: receives the number of
/// points. `point_done`: called after each. Errors: every fault of every case; there are no cases.
Result<std::vector<VerifiedCase>> verify_cases(const std::vector<std::string>& names,
                                               const std::function<void(int)>& begin = {},
                                               const std::function<void()>& point_done = {});

struct VerifyCounts {
  std::size_t checks = 0, failed = 0, known = 0;
};
VerifyCounts counts_of(const std::vector<VerifiedCase>& cases);

/// {"checks", "failed", "known_deviations", "cases": [{"case", "title", "source", "rows": [...]}, ...]}
nlohmann::ordered_json to_json(const std::vector<VerifiedCase>& cases);

}  // namespace pastefit
