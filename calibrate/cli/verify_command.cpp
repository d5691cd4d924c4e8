#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/verify/verify.h"

namespace pastefit {

namespace {

struct VerifyOptions {
  std::vector<std::string> cases;
  bool json = false;
  bool points = false;
  bool formulas = false;
};

void print_row(const std::string& name, const CheckRow& row, std::size_t points) {
  std::string at = row.point;
  if (points > 1) at += " (worst of " + std::to_string(points) + ")";
  print("%-23s %-28s %s%13.6g %14.6g %9.2e %9.0e  %-5s %s\n", name.c_str(), row.reading.c_str(), row.bound ? "<" : " ",
        row.expected, row.got, row.error, row.tolerance, std::string(name_of(row.verdict)).c_str(), at.c_str());
}

/// Prints the reason of each check that did not pass; equal ones once.
void print_notes(const std::vector<CheckRow>& rows) {
  std::set<std::string> told;
  for (const CheckRow& row : rows)
    if (!row.note.empty() && told.insert(row.note).second) print("  %s\n", row.note.c_str());
}

void print_cases(const std::vector<VerifiedCase>& cases, bool every_point) {
  print("%-23s %-28s %14s %14s %9s %9s  %-5s %s\n", "case", "reading", "expected", "got", "error", "tolerance", "",
        "at");
  for (const auto& [file, test, rows] : cases) {
    for (const CheckRow& row : every_point ? rows : worst_rows(rows))
      print_row(test.name, row, every_point ? 1 : test.points.size());
    print_notes(rows);
  }
}

int run_verify(const VerifyOptions& options) {
  if (options.formulas) {
    for (const Formula& formula : formulas())
      print("%-22s %s\n", std::string(formula.name).c_str(), std::string(formula.meaning).c_str());
    return kDone;
  }
  std::optional<WorkLine> line;
  const auto begin = [&](int points) { line.emplace("points", points); };
  const auto verified = verify_cases(options.cases, begin, [&] { line->one_done(); });
  if (line) line->clear();
  const std::vector<VerifiedCase> cases = value_or_throw(verified);
  const VerifyCounts counts = counts_of(cases);
  if (options.json) {
    print("%s", json_text(to_json(cases)).c_str());
  } else {
    print_cases(cases, options.points);
    print("%zu cases, %zu checks, %zu failed, %zu known deviations\n", cases.size(), counts.checks, counts.failed,
          counts.known);
  }
  return counts.failed == 0 ? kDone : kFailed;
}

}  // namespace

Command add_verify(CLI::App& verb) {
  const auto options = std::make_shared<VerifyOptions>();
  verb.add_option("CASE", options->cases, "names of shipped cases, or case files; default: all shipped cases");
  verb.add_flag("--json", options->json, "print every check at every point as JSON");
  verb.add_flag("--points", options->points, "print every point of a case, not only its worst");
  verb.add_flag("--formulas", options->formulas, "list the closed forms that a case may name");
  return [options] { return run_verify(*options); };
}

}  // namespace pastefit
