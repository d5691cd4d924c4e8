#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibrate/verify/case.h"

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

}  // namespace pastefit
