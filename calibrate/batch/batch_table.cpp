#include "calibrate/batch/batch_table.h"

#include <array>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "calibrate/base/text.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/report/page.h"
#include "calibrate/report/summary.h"
#include "calibrate/search/calibration.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/store/store.h"

namespace pastefit {

namespace {

/// From the worst; then come those with reservations, and the others.
constexpr std::array verdicts{"failed", "out_of_reach", "unconfirmed", "stopped", "unfinished", "pending"};

/// Of the packings that confirmed the card, how many a laboratory would have rejected in some fitted test; nothing if
/// its tests are of kinds of which none is.
std::optional<double> sheared_share_of(const Card& card) {
  bool known = false;
  std::size_t runs = 0;
  for (const CardTest& test : card.tests)
    if (!test.hold_out) runs = std::max(runs, test.baseline.runs.size());
  std::vector<bool> rejected(runs, false);
  for (const CardTest& test : card.tests) {
    if (test.hold_out) continue;
    for (std::size_t i = 0; i < test.baseline.runs.size(); ++i)
      if (const auto index = rejection_index(test.test, test.baseline.runs[i].readings)) {
        known = true;
        if (*index > 1) rejected[i] = true;
      }
  }
  if (!known) return std::nullopt;
  return static_cast<double>(std::ranges::count(rejected, true)) / static_cast<double>(runs);
}

std::vector<BatchRow::Number> laboratory_of(const Study& study) {
  const Lab& lab = study.tests.front().lab;
  std::vector<BatchRow::Number> out{{"material.bulk_density_kg_m3", specimen_of(lab.test).bulk_density_kg_m3}};
  for (const StudyTest& test : study.tests)
    for (const MixVariable& one : test.lab.mix)
      if (!find_named(out, "mix." + one.name)) out.push_back({"mix." + one.name, one.value});
  return out;
}

void add(BatchRow& row, const Card& card) {
  row.verdict = card.search.status;
  std::vector<std::string> reasons = reservations_on(card);
  if (row.verdict != name_of(CalibrationStatus::confirmed)) reasons.insert(reasons.begin(), card.search.reason);
  for (const std::string& reason : reasons) row.reasons += (row.reasons.empty() ? "" : "; ") + reason;
  row.error = card.confirmation.error;
  row.sheared_share = sheared_share_of(card);
  row.simulations = card.search.simulations;
  row.coarse_simulations = card.search.coarse_simulations;
  row.program = card.provenance.program;
  for (const CardTest& test : card.tests)
    for (const CardReading& one : test.readings)
      if (one.measured) row.readings.push_back({reading_name(test, one.name), *one.measured, one.simulated});
  for (const Parameter& one : card.material.parameters) {
    if (!one.free || !has_parameter(card, one.name)) continue;
    const auto& known = card.inference.intervals;
    const auto interval = std::ranges::find(known, one.name, &CardInference::Interval::parameter);
    row.parameters.push_back({one.name, one.value, {}, {}, {}});
    if (interval == known.end()) continue;
    row.parameters.back().lower = interval->lower;
    row.parameters.back().upper = interval->upper;
    row.parameters.back().at_bounds = ends_at_bounds(*interval, one);
  }
}

/// The text as one cell. A spreadsheet would compute one that begins as a formula does: it gets an apostrophe.
std::string quoted(const std::string& text) {
  std::string line = one_line(text);
  if (!line.empty() && std::string_view("=+-@").find(line[0]) != std::string_view::npos) line.insert(0, 1, '\'');
  if (line.find_first_of(",\"") == std::string::npos) return line;
  std::string out = "\"";
  for (const char letter : line) out += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return out + "\"";
}

std::string cell(std::optional<double> value) {
  return value ? nlohmann::json(*value).dump() : "";
}

/// Which ends of the interval the readings do not set.
std::string bounds_of(const BatchRow::Fitted& one) {
  const auto [lower, upper] = one.at_bounds;
  return lower && upper ? "both" : lower ? "lower" : upper ? "upper" : "";
}

/// The columns that some rows have and others have not.
struct TableColumns {
  std::vector<std::string> laboratory, readings, parameters;
};

std::string header(const TableColumns& columns) {
  std::string out =
      "study,title,verdict,reasons,seed,simulations,coarse_simulations,core_s,misfit_tolerances,sheared_share";
  for (const auto& name : columns.laboratory) out += "," + quoted(name);
  for (const auto& name : columns.readings)
    for (const char* what : {"measured_", "simulated_", "deviation_"}) out += "," + quoted(what + name);
  for (const auto& name : columns.parameters)
    out += "," + name + ",lower_" + name + ",upper_" + name + ",at_bounds_" + name;
  return out + ",program\n";
}

std::string line(const BatchRow& row, const TableColumns& columns) {
  std::string out;
  for (const std::string& text : {row.name, row.title, row.verdict, row.reasons}) out += quoted(text) + ",";
  out += std::to_string(row.seed) + "," + std::to_string(row.simulations) + "," +
         std::to_string(row.coarse_simulations) + "," + cell(row.core_s) + "," + cell(row.error) + "," +
         cell(row.sheared_share);
  for (const auto& name : columns.laboratory) {
    const auto* one = find_named(row.laboratory, name);
    out += "," + (one ? cell(one->value) : "");
  }
  for (const auto& name : columns.readings) {
    const auto* one = find_named(row.readings, name);
    out += one ? "," + cell(one->measured) + "," + cell(one->simulated) + "," + cell(one->simulated - one->measured)
               : ",,,";
  }
  for (const auto& name : columns.parameters) {
    const auto* one = find_named(row.parameters, name);
    out +=
        one ? "," + cell(one->value) + "," + cell(one->lower) + "," + cell(one->upper) + "," + bounds_of(*one) : ",,,,";
  }
  return out + "," + quoted(row.program) + "\n";
}

}  // namespace

BatchRow row_of(const BatchStudy& one) {
  BatchRow row;
  row.name = one.name;
  row.title = one.study.title;
  row.seed = one.study.search.seed;
  row.laboratory = laboratory_of(one.study);
  std::error_code error;
  const bool begun = std::filesystem::exists(one.folder / kStore, error);
  if (begun)
    if (const auto store = Store::read(one.folder / kStore); store.ok()) {
      const auto evaluations = store.value().all();
      row.simulations = static_cast<int>(evaluations.size());
      for (const StoredEvaluation& evaluation : evaluations)
        row.core_s += evaluation.core_s > 0 ? evaluation.core_s : evaluation.wall_s;
    }
  if (const auto failure = read_failure(one)) {
    row.verdict = failure->status;
    row.reasons = failure->reason;
  } else if (const auto card = card_of_batch(one)) {
    add(row, *card);
  } else {
    row.verdict = begun ? "unfinished" : "pending";
  }
  return row;
}

int rank_of(const BatchRow& row) {
  const auto found = std::ranges::find(verdicts, row.verdict);
  if (found != verdicts.end()) return static_cast<int>(std::distance(verdicts.begin(), found));
  return static_cast<int>(verdicts.size()) + (row.reasons.empty() ? 1 : 0);
}

std::vector<BatchRow> worst_first(std::vector<BatchRow> rows) {
  std::ranges::stable_sort(rows, [](const BatchRow& one, const BatchRow& other) {
    if (rank_of(one) != rank_of(other)) return rank_of(one) < rank_of(other);
    return one.error.value_or(0) > other.error.value_or(0);
  });
  return rows;
}

std::string batch_csv(const std::vector<BatchRow>& rows) {
  const TableColumns columns{names_in(rows, &BatchRow::laboratory), names_in(rows, &BatchRow::readings),
                             names_in(rows, &BatchRow::parameters)};
  std::string out = header(columns);
  for (const BatchRow& row : rows) out += line(row, columns);
  return out;
}

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --page: #fbfbf9; --text: #1c2126; --soft: #59636e; --rule: #d9dcdf;
  --good: #00694d; --bad: #a63c00; --open: #6d5600; --laboratory: #c14d00; --simulation: #0068ad; }
@media (prefers-color-scheme: dark) { :root { --page: #14181c; --text: #e4e8eb; --soft: #a2adb7; --rule: #343c44;
  --good: #58d3ad; --bad: #ff9e66; --open: #e7cd6b; --laboratory: #ff9a4d; --simulation: #5cb8f5; } }
body { font: 1rem/1.45 system-ui, sans-serif; background: var(--page); color: var(--text); margin: 1.5rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.94rem; }
th, td { text-align: left; vertical-align: top; padding: 0.4rem 0.75rem 0.4rem 0; border-bottom: 1px solid var(--rule); }
thead th { color: var(--soft); font-weight: 500; font-size: 0.85rem; vertical-align: bottom; }
td.reasons { min-width: 18rem; max-width: 30rem; }
td.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
a { color: var(--simulation); }
.met .verdict { color: var(--good); } .open .verdict { color: var(--open); } .bad .verdict { color: var(--bad); }
.measured { color: var(--laboratory); } .simulated { color: var(--simulation); } .soft { color: var(--soft); }
)";

/// A folder's name as part of a link.
std::string in_link(const std::string& name) {
  std::string out;
  for (const char letter : name) {
    const auto byte = static_cast<unsigned char>(letter);
    out += std::isalnum(byte) || letter == '-' || letter == '_' || letter == '.' ? std::string(1, letter)
                                                                                 : format("%%%02X", byte);
  }
  return out;
}

std::string number(std::optional<double> value, const char* kind = "") {
  return "<td class=\"number " + std::string(kind) + "\">" + (value ? plain(*value, 4) : "") + "</td>";
}

std::string head(const std::string& text) {
  return "<th>" + xml_text(text) + "</th>";
}

struct Names {
  std::vector<std::string> laboratory, readings, parameters;
};

std::string head_of(const Names& names) {
  std::string out = "<thead><tr>" + head("study") + head("verdict") + head("reasons") +
                    head("largest error, tolerances") + head("sheared share");
  for (const auto& name : names.readings) out += head(name + " measured") + head("simulated") + head("deviation");
  for (const auto& name : names.parameters) out += head(name) + head("95 % interval");
  for (const auto& name : names.laboratory) out += head(name);
  return out + head("simulations") + head("core s") + head("seed") + "</tr></thead>\n";
}

std::string interval(const BatchRow::Fitted& one) {
  if (!one.lower && !one.upper) return "<td></td>";
  if (one.lower && one.upper)
    return "<td class=\"number soft\">" + interval_in_words(*one.lower, *one.upper, one.at_bounds, 3) + "</td>";
  const auto end = [](std::optional<double> value) { return value ? plain(*value, 3) : std::string("?"); };
  return "<td class=\"number soft\">" + end(one.lower) + " to " + end(one.upper) + "</td>";
}

std::string row_in_html(const BatchRow& row, const Names& names) {
  const bool met = row.verdict == "confirmed";
  std::string out = std::string("<tr class=\"") + (!met ? "bad" : row.reasons.empty() ? "met" : "open") + "\">";
  const std::string name = xml_text(one_line(row.name)), title = xml_text(one_line(row.title));
  const bool page = row.verdict != "pending";
  out += "<td>" + (page ? "<a href=\"" + in_link(row.name) + "/" + kPage + "\">" + name + "</a>" : name) +
         "<br><span class=\"soft\">" + title + "</span></td>";
  out += "<td class=\"verdict\">" + xml_text(row.verdict) + (met && !row.reasons.empty() ? ", with reservations" : "") +
         "</td><td class=\"reasons\">" + xml_text(one_line(row.reasons)) + "</td>";
  out += number(row.error) + number(row.sheared_share);
  for (const auto& reading : names.readings) {
    const auto* one = find_named(row.readings, reading);
    out += one ? number(one->measured, "measured") + number(one->simulated, "simulated") +
                     number(one->simulated - one->measured)
               : "<td></td><td></td><td></td>";
  }
  for (const auto& parameter : names.parameters) {
    const auto* one = find_named(row.parameters, parameter);
    out += one ? number(one->value) + interval(*one) : "<td></td><td></td>";
  }
  for (const auto& variable : names.laboratory) {
    const auto* one = find_named(row.laboratory, variable);
    out += number(one ? one->value : std::nullopt);
  }
  return out + number(row.simulations) + number(row.core_s) + number(static_cast<double>(row.seed)) + "</tr>\n";
}

/// "20 studies: 2 unconfirmed, 18 confirmed."
std::string count_of(const std::vector<BatchRow>& rows) {
  std::string out = format("%zu %s", rows.size(), rows.size() == 1 ? "study" : "studies");
  std::map<std::string, int> counts;
  for (const BatchRow& row : rows) ++counts[row.verdict];
  const char* before = ": ";
  for (const auto& [verdict, count] : counts) {
    out += before + format("%d ", count) + verdict;
    before = ", ";
  }
  return out + ".";
}

}  // namespace

std::string batch_page(const std::vector<BatchRow>& rows) {
  const Names names{names_in(rows, &BatchRow::laboratory), names_in(rows, &BatchRow::readings),
                    names_in(rows, &BatchRow::parameters)};
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\"><title>pastefit: batch</title>\n<style>" +
      std::string(kStyle) + "</style></head>\n<body><h1>Batch</h1>\n<p>" + xml_text(count_of(rows)) +
      " Those that did not meet the laboratory stand on top. Units are in the names of the columns.</p>\n"
      "<div class=\"wide\"><table>" +
      head_of(names) + "<tbody>\n";
  for (const BatchRow& row : worst_first(rows)) out += row_in_html(row, names);
  return out + "</tbody></table></div></body></html>\n";
}

}  // namespace pastefit
