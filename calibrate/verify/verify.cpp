#include "calibrate/verify/verify.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/base/text.h"
#include "core/step/run.h"

namespace pastefit {

namespace {

constexpr double kPublishedDigits = 1e-3;  // figures have at least four digits; their constants differ

Result<double> expected_value(const Check& check, const Impact& scene, const Point& point) {
  if (!check.formula) return check.expected;
  auto value = value_of(*check.formula, scene, check.arguments);
  if (!value) {
    Faults faults = value.faults();
    for (Fault& fault : faults) fault.where = check.reading + " at \"" + point.label + "\": " + fault.where;
    return faults;
  }
  const auto printed = point.published.find(check.reading);
  if (printed == point.published.end()) return value;
  if (std::fabs(value.value() / printed->second - 1) < kPublishedDigits) return value;
  return Fault{check.reading + " at \"" + point.label + "\"",
               "the formula gives " + std::to_string(value.value()) + ", not what is published",
               "correct the scene or the published figure"};
}

/// Computes error and verdict.
void judge(const Check& check, CheckRow& row) {
  row.tolerance = check.tolerance;
  row.absolute = check.absolute;
  row.bound = check.at_most;
  row.error = row.bound ? std::max(row.got - row.expected, 0.0) : std::fabs(row.got - row.expected);
  if (!row.absolute && !row.bound) row.error /= std::fabs(row.expected);
  // A NaN error must not pass.
  const bool good = row.error <= row.tolerance;
  row.verdict = good ? CaseVerdict::pass : check.known_deviation.empty() ? CaseVerdict::fail : CaseVerdict::known;
  if (!good) row.note = check.known_deviation;
}

CheckRow without_answer(CheckRow row, const Check& check, std::string why) {
  row.got = row.error = std::nan("");
  row.tolerance = check.tolerance;
  row.note = std::move(why);
  return row;
}

CheckRow compare_views(const Check& check, const Impact& scene, const Outcome& outcome, CheckRow row) {
  const Transform transform = *check.unchanged_under;
  const Outcome seen = simulate(transformed(scene, transform));
  row.reading = claim_of(transform);
  if (seen.failure) return without_answer(std::move(row), check, seen.failure->message);
  row.got = difference(scene, outcome, transform, seen);
  judge(check, row);
  return row;
}

Result<CheckRow> compared(const Check& check, const Point& point, const Impact& scene, const Outcome& outcome) {
  CheckRow row;
  row.point = point.label;
  row.reading = check.reading;
  const auto expected = expected_value(check, scene, point);
  if (!expected) return expected.faults();
  row.expected = expected.value();
  if (outcome.failure)
    return without_answer(std::move(row), check,
                          std::string(name_of(outcome.failure->reason)) + ": " + outcome.failure->message);
  if (check.unchanged_under) return compare_views(check, scene, outcome, std::move(row));
  const auto got = outcome.readings.find(check.reading);
  if (!got) return without_answer(std::move(row), check, "the test has no such reading");
  row.got = *got;
  judge(check, row);
  return row;
}

}  // namespace

std::string_view name_of(CaseVerdict verdict) {
  return verdict == CaseVerdict::pass ? "pass" : verdict == CaseVerdict::known ? "known" : "FAIL";
}

Result<std::vector<CheckRow>> verify(const Case& test, const std::function<void()>& point_done) {
  std::vector<CheckRow> rows;
  Faults faults;
  for (const Point& point : test.points) {
    const auto scene = value_or_append(scene_at(test, point), faults);
    if (!scene) continue;
    const Outcome outcome = simulate(scene.value());
    for (std::size_t c = 0; c < test.checks.size(); ++c) {
      auto row = value_or_append(compared(test.checks[c], point, scene.value(), outcome), faults);
      if (!row) continue;
      rows.push_back(std::move(row).value());
      rows.back().check = c;
    }
    if (point_done) point_done();
  }
  if (!faults.empty()) return faults;
  return rows;
}

std::vector<CheckRow> worst_rows(const std::vector<CheckRow>& rows) {
  const auto burden = [](const CheckRow& row) {
    if (std::isnan(row.error)) return 1e300;
    return row.tolerance > 0 ? row.error / row.tolerance : row.error * 1e100;
  };
  std::vector<CheckRow> worst;
  for (const CheckRow& row : rows) {
    const auto same = std::ranges::find(worst, row.check, &CheckRow::check);
    if (same == worst.end())
      worst.push_back(row);
    else if (burden(row) > burden(*same))
      *same = row;
  }
  return worst;
}

namespace {

namespace fs = std::filesystem;

/// Shipped case with this name, otherwise the file.
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
    auto test = value_or_append(read_case(file), faults);
    if (!test) continue;
    points += test.value().points.size();
    cases.push_back({file, std::move(test).value(), {}});
  }
  if (begin) begin(static_cast<int>(points));
  for (VerifiedCase& one : cases) {
    auto rows = verify(one.test, point_done);
    if (rows.ok())
      one.rows = std::move(rows).value();
    else
      append(faults, in_file(rows.faults(), one.file));
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
