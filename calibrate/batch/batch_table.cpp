#include "calibrate/batch/batch_table.h"

#include <array>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "calibrate/base/text.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/report/reservations.h"
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

}  // namespace pastefit
