#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "calibrate/base/fault_text.h"
#include "calibrate/base/foreign_text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/cli/work_line.h"
#include "calibrate/verify/verify.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

struct VerifyOptions {
  std::vector<std::string> cases;
  bool json = false;
  bool points = false;
  bool formulas = false;
};

struct VerifiedCase {
  Case test;
  std::vector<CheckRow> rows;
};

/// The shipped case of that name, or else the file.
fs::path file_of(const std::string& name, const std::vector<fs::path>& shipped) {
  const auto found = std::ranges::find_if(shipped, [&](const fs::path& file) { return file.stem() == name; });
  return found == shipped.end() ? fs::path(name) : *found;
}

void print_header() {
  print("%-23s %-28s %14s %14s %9s %9s  %-5s %s\n", "case", "reading", "expected", "got", "error", "tolerance", "",
        "at");
}

void print_row(const std::string& name, const CheckRow& row, std::size_t points) {
  std::string at = row.point;
  if (points > 1) at += " (worst of " + std::to_string(points) + ")";
  print("%-23s %-28s %s%13.6g %14.6g %9.2e %9.0e  %-5s %s\n", name.c_str(), row.reading.c_str(), row.bound ? "<" : " ",
        row.expected, row.got, row.error, row.tolerance, std::string(name_of(row.verdict)).c_str(), at.c_str());
}

/// The reasons for what is not a pass, each once.
void print_notes(const std::vector<CheckRow>& rows) {
  std::set<std::string> told;
  for (const CheckRow& row : rows)
    if (!row.note.empty() && told.insert(row.note).second) print("  %s\n", row.note.c_str());
}

void print_cases(const std::vector<VerifiedCase>& cases, bool every_point) {
  print_header();
  for (const auto& [test, rows] : cases) {
    for (const CheckRow& row : every_point ? rows : worst_rows(rows))
      print_row(test.name, row, every_point ? 1 : test.points.size());
    print_notes(rows);
  }
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

int verify_cases(const VerifyOptions& options) {
  if (options.formulas) {
    for (const Formula& formula : formulas())
      print("%-22s %s\n", std::string(formula.name).c_str(), std::string(formula.meaning).c_str());
    return kDone;
  }
  const auto shipped = shipped_cases();
  if (shipped.empty() && options.cases.empty())
    return report({{"verify", "no cases were found", "set PASTEFIT_DATA_DIR to the data folder of pastefit"}});
  std::vector<fs::path> files = shipped;
  if (!options.cases.empty()) {
    files.clear();
    for (const auto& name : options.cases) files.push_back(file_of(name, shipped));
  }

  Faults faults;
  std::vector<VerifiedCase> cases;
  std::vector<fs::path> readable;
  std::size_t points = 0;
  for (const fs::path& file : files) {
    auto test = read_case(file);
    if (!test.ok()) {
      faults.insert(faults.end(), test.faults().begin(), test.faults().end());
      continue;
    }
    points += test.value().points.size();
    readable.push_back(file);
    cases.push_back({std::move(test).value(), {}});
  }
  WorkLine line("points", static_cast<int>(points));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    auto rows = verify(cases[i].test, [&] { line.one_done(); });
    if (rows.ok())
      cases[i].rows = std::move(rows).value();
    else
      for (Fault& fault : in_file(rows.faults(), readable[i])) faults.push_back(std::move(fault));
  }
  line.clear();
  if (!faults.empty()) return report(faults);

  std::size_t checks = 0, failed = 0, known = 0;
  for (const auto& [test, rows] : cases) {
    checks += rows.size();
    failed += static_cast<std::size_t>(std::ranges::count(rows, CaseVerdict::fail, &CheckRow::verdict));
    known += static_cast<std::size_t>(std::ranges::count(rows, CaseVerdict::known, &CheckRow::verdict));
  }
  if (options.json) {
    nlohmann::ordered_json out{{"checks", checks}, {"failed", failed}, {"known_deviations", known}};
    for (const VerifiedCase& verified : cases) out["cases"].push_back(case_json(verified));
    print("%s", json_text(out).c_str());
  } else {
    print_cases(cases, options.points);
    print("%zu cases, %zu checks, %zu failed, %zu known deviations\n", cases.size(), checks, failed, known);
  }
  return failed == 0 ? kDone : kFailed;
}

}  // namespace

Command add_verify(CLI::App& verb) {
  const auto options = std::make_shared<VerifyOptions>();
  verb.add_option("CASE", options->cases, "names of shipped cases, or case files; all shipped ones if none is given");
  verb.add_flag("--json", options->json, "print every check at every point as JSON");
  verb.add_flag("--points", options->points, "print every point of a case, not only its worst");
  verb.add_flag("--formulas", options->formulas, "list the closed forms that a case may name");
  return [options] { return verify_cases(*options); };
}

}  // namespace pastefit
