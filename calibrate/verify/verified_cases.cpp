#include "calibrate/verify/verified_cases.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/base/fault_text.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

/// The shipped case of that name, or else the file.
fs::path file_of(const std::string& name, const std::vector<fs::path>& shipped) {
  const auto found = std::ranges::find_if(shipped, [&](const fs::path& file) { return file.stem() == name; });
  return found == shipped.end() ? fs::path(name) : *found;
}

nlohmann::ordered_json case_json(const VerifiedCase& verified) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const CheckRow& row : verified.rows)
    rows.push_back({{"point", row.point},
                    {"reading", row.reading},
                    {row.bound ? "at_most" : "expected", row.expected},
                    {"got", row.got},
                    {"error", row.error},
                    {"error_is", row.absolute || row.bound ? "absolute" : "relative"},
                    {"tolerance", row.tolerance},
                    {"verdict", name_of(row.verdict)},
                    {"note", row.note}});
  return {{"case", verified.test.name},
          {"title", verified.test.title},
          {"source", verified.test.source},
          {"rows", std::move(rows)}};
}

}  // namespace

Result<std::vector<VerifiedCase>> verify_cases(const std::vector<std::string>& names,
                                               const std::function<void(int)>& begin,
                                               const std::function<void()>& point_done) {
  const auto shipped = shipped_cases();
  if (shipped.empty() && names.empty())
    return Fault{"verify", "no cases were found", "set PASTEFIT_DATA_DIR to the data folder of pastefit"};
  std::vector<fs::path> files = shipped;
  if (!names.empty()) {
    files.clear();
    for (const auto& name : names) files.push_back(file_of(name, shipped));
  }
  Faults faults;
  std::vector<VerifiedCase> cases;
  std::size_t points = 0;
  for (const fs::path& file : files) {
    auto test = read_case(file);
    if (!test.ok()) {
      faults.insert(faults.end(), test.faults().begin(), test.faults().end());
      continue;
    }
    points += test.value().points.size();
    cases.push_back({file, std::move(test).value(), {}});
  }
  if (begin) begin(static_cast<int>(points));
  for (VerifiedCase& one : cases) {
    auto rows = verify(one.test, point_done);
    if (rows.ok())
      one.rows = std::move(rows).value();
    else
      for (Fault& fault : in_file(rows.faults(), one.file)) faults.push_back(std::move(fault));
  }
  if (!faults.empty()) return faults;
  return cases;
}

VerifyCounts counts_of(const std::vector<VerifiedCase>& cases) {
  VerifyCounts counts;
  for (const VerifiedCase& one : cases) {
    counts.checks += one.rows.size();
    counts.failed += static_cast<std::size_t>(std::ranges::count(one.rows, CaseVerdict::fail, &CheckRow::verdict));
    counts.known += static_cast<std::size_t>(std::ranges::count(one.rows, CaseVerdict::known, &CheckRow::verdict));
  }
  return counts;
}

nlohmann::ordered_json to_json(const std::vector<VerifiedCase>& cases) {
  const VerifyCounts counts = counts_of(cases);
  nlohmann::ordered_json out{{"checks", counts.checks}, {"failed", counts.failed}, {"known_deviations", counts.known}};
  for (const VerifiedCase& verified : cases) out["cases"].push_back(case_json(verified));
  return out;
}

}  // namespace pastefit
