#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calibrate/verify/verify.h"
#include "core/result.h"

namespace pastefit {

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
