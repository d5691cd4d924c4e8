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

/// How a check ended.
enum class CaseVerdict {
  pass,
  known,  ///< it fails, as its file says it does and why
  fail
};

std::string_view name_of(CaseVerdict verdict);

/// One check at one point of a case.
struct CheckRow {
  std::size_t check = 0;  ///< index in the case
  std::string point;      ///< label; empty if the case has one only
  std::string reading;
  double expected = 0, got = 0;
  double error = 0;  ///< relative or absolute, as the check says; of a bound: by how much it is exceeded
  double tolerance = 0;
  bool absolute = false;
  bool bound = false;  ///< `expected` is the largest value allowed
  CaseVerdict verdict = CaseVerdict::fail;
  std::string note;  ///< of a known deviation, or of a run without an answer
};

/// Runs every point of a case. Rows: for each point, for each check.
/// `point_done` is called after each point.
/// Errors: faults of the scene, and formulas that do not hold for it; nothing is then reported.
Result<std::vector<CheckRow>> verify(const Case& test, const std::function<void()>& point_done = {});

/// For each check of the case the row with the largest error over its tolerance.
std::vector<CheckRow> worst_rows(const std::vector<CheckRow>& rows);

/// A case file and how its checks ended.
struct VerifiedCase {
  std::filesystem::path file;
  Case test;
  std::vector<CheckRow> rows;
};

/// Runs these cases: names of shipped ones, or files; all shipped ones if there is no name. `begin` is told how many
/// points there are, `point_done` when one is done.
/// Errors: every fault of every case; there is none.
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
