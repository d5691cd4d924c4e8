#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <optional>
#include <system_error>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/batch/batch.h"
#include "calibrate/card/standing.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/report/page.h"
#include "calibrate/report/summary.h"
#include "calibrate/search/calibration.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/store/store.h"

namespace pastefit {

namespace {

using nlohmann::ordered_json;

/// Rejected fraction of the confirmation packings over all fitted tests; nothing for kinds of tests without rejection.
ordered_json sheared_share_of(const Card& card) {
  const auto is_judged = [](const CardTest& one) {
    return !one.hold_out && !one.baseline.runs.empty() && rejection_index(one.test, {}).has_value();
  };
  if (std::ranges::none_of(card.tests, is_judged)) return nullptr;
  const Evidence evidence = evidence_of(card.tests);
  return static_cast<double>(evidence.rejected) / evidence.heaps;
}

/// Whether each held-out test was predicted; nothing without one that was judged.
ordered_json prediction_of(const Card& card) {
  std::string out;
  for (const CardTest& test : card.tests)
    if (test.within_noise) out += (out.empty() ? "" : "; ") + hold_out_in_words(test);
  return out.empty() ? ordered_json() : ordered_json(out);
}

ordered_json laboratory_columns(const Study& study) {
  if (study.tests.empty()) return ordered_json::object();
  ordered_json out{{"material.bulk_density_kg_m3", specimen_of(study.tests.front().lab.test).bulk_density_kg_m3}};
  for (const StudyTest& test : study.tests)
    for (const MixVariable& one : test.lab.mix) out.emplace("mix." + one.name, one.value);
  return out;
}

ordered_json reading_columns(const Card& card) {
  auto out = ordered_json::object();
  for (const CardTest& test : card.tests)
    for (const CardReading& one : test.readings) {
      if (!one.measured) continue;
      const std::string name = reading_name(test, one.name);
      out["measured_" + name] = *one.measured;
      out["simulated_" + name] = one.simulated.mean;
      out["deviation_" + name] = one.simulated.mean - *one.measured;
    }
  return out;
}

/// Fitted parameters with their 95 % intervals, if known, and the ends that the readings do not determine.
ordered_json parameter_columns(const Card& card) {
  auto out = ordered_json::object();
  for (const Parameter& one : card.material.parameters) {
    if (!one.free || !has_parameter(card, one.name)) continue;
    const auto& known = card.inference.intervals;
    const auto interval = std::ranges::find(known, one.name, &CardInference::Interval::parameter);
    const bool is_known = interval != known.end();
    const BoundEnds ends = is_known ? ends_at_bounds(*interval, one) : BoundEnds{};
    out[one.name] = one.value;
    out["lower_" + one.name] = is_known ? ordered_json(interval->lower) : nullptr;
    out["upper_" + one.name] = is_known ? ordered_json(interval->upper) : nullptr;
    out["at_bounds_" + one.name] = ends.lower && ends.upper ? "both" : ends.lower ? "lower" : ends.upper ? "upper" : "";
  }
  return out;
}

std::string reasons_of(const Card& card) {
  std::vector<std::string> reasons = reservations_on(card);
  if (card.search.status != name_of(CalibrationStatus::confirmed)) reasons.insert(reasons.begin(), card.search.reason);
  return listed(reasons, {}, "; ");
}

/// Simulations and processor time in the store.
ordered_json spent_on(const BatchStudy& one) {
  std::size_t simulations = 0;
  double core_s = 0;
  if (const auto store = Store::read(one.folder / kStore); store.ok())
    for (const StoredEvaluation& evaluation : store.value().all()) {
      ++simulations;
      core_s += evaluation.core_s > 0 ? evaluation.core_s : evaluation.wall_s;
    }
  return {{"simulations", simulations}, {"coarse_simulations", 0}, {"core_s", core_s}};
}

/// Text as one cell. An apostrophe protects texts that spreadsheets would evaluate as formulas.
std::string quoted(const std::string& text) {
  std::string line = one_line(text);
  if (!line.empty() && std::string_view("=+-@").find(line[0]) != std::string_view::npos) line.insert(0, 1, '\'');
  if (line.find_first_of(",\"") == std::string::npos) return line;
  std::string out = "\"";
  for (const char letter : line) out += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return out + "\"";
}

std::string csv_cell(const ordered_json& value) {
  return value.is_null() ? "" : value.is_string() ? quoted(value.get<std::string>()) : value.dump();
}

/// Columns of all rows, in order of first appearance.
std::array<std::vector<std::string>, 5> columns_of(const std::vector<BatchRow>& rows) {
  std::array<std::vector<std::string>, 5> names;
  for (const BatchRow& row : rows)
    for (std::size_t part = 0; part < names.size(); ++part)
      for (const auto& [name, value] : row.columns[part].items())
        if (std::ranges::find(names[part], name) == names[part].end()) names[part].push_back(name);
  return names;
}

/// Calls `see` for each column with the row's value, or null.
template <class See>
void see_cells(const BatchRow& row, const std::array<std::vector<std::string>, 5>& columns, See see) {
  for (std::size_t part = 0; part < columns.size(); ++part)
    for (const std::string& name : columns[part])
      see(name, row.columns[part].contains(name) ? row.columns[part][name] : ordered_json());
}

BatchRow row_with(const BatchStudy& one, const std::optional<BatchFailure>& failure, const std::optional<Card>& card) {
  BatchRow row{one.name, "pending", "", 0, {}};
  auto& [whole, laboratory, readings, parameters, made_by] = row.columns;
  std::error_code error;
  if (std::filesystem::exists(one.folder / kStore, error)) row.verdict = "unfinished";
  ordered_json spent = spent_on(one), program = "", error_of_card, sheared_share, prediction;
  laboratory = laboratory_columns(one.study);
  if (failure) {
    row.verdict = failure->status;
    row.reasons = failure->reason;
  } else if (card) {
    row.verdict = card->search.status;
    row.reasons = reasons_of(*card);
    row.error = card->confirmation.error;
    error_of_card = row.error;
    sheared_share = sheared_share_of(*card);
    prediction = prediction_of(*card);
    spent["simulations"] = card->search.simulations;
    spent["coarse_simulations"] = card->search.coarse_simulations;
    program = card->provenance.program;
    readings = reading_columns(*card);
    parameters = parameter_columns(*card);
  }
  whole = {{"study", one.name},
           {"title", one.study.title},
           {"verdict", row.verdict},
           {"misfit_tolerances", error_of_card},
           {"sheared_share", sheared_share},
           {"prediction", prediction},
           {"reasons", row.reasons},
           {"seed", one.study.search.seed}};
  whole.update(spent);
  made_by["program"] = program;
  return row;
}

}  // namespace

BatchRow row_of(const BatchStudy& one) {
  return row_with(one, read_failure(one), card_of_batch(one));
}

std::vector<BatchRow> rows_in(const std::filesystem::path& folder) {
  std::error_code error;
  const auto holds = [&](const std::filesystem::path& place) {
    return std::ranges::any_of(std::array{kCardFile, kStore, kFailureFile},
                               [&](const std::string& name) { return std::filesystem::exists(place / name, error); });
  };
  std::vector<BatchRow> rows;
  if (holds(folder)) return rows;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (!entry.is_directory(error) || !holds(entry.path())) continue;
    BatchStudy one{entry.path().filename().string(), {}, entry.path(), {}};
    auto failure = read_failure(one);
    std::optional<Card> card;
    if (auto read = read_card(entry.path() / kCardFile); read.ok()) {
      card = std::move(read).value();
      one.study = study_of(*card);
    } else if (std::filesystem::exists(entry.path() / kCardFile, error)) {
      failure = {"failed", "its card is damaged"};
    }
    rows.push_back(row_with(one, failure, card));
  }
  std::ranges::sort(rows, {}, &BatchRow::study);
  return rows;
}

std::string batch_csv(const std::vector<BatchRow>& rows) {
  const auto columns = columns_of(rows);
  const auto line_of = [&](const BatchRow& row, auto cell) {
    std::string line;
    see_cells(row, columns,
              [&](const std::string& name, const ordered_json& value) { line += "," + cell(name, value); });
    return line.substr(1) + "\n";
  };
  std::string out = line_of({}, [](const std::string& name, const ordered_json&) { return quoted(name); });
  for (const BatchRow& row : rows)
    out += line_of(row, [](const std::string&, const ordered_json& value) { return csv_cell(value); });
  return out;
}

namespace {

/// Rank of a verdict, worst first; then those with reservations, then the others.
std::ptrdiff_t rank_of(const BatchRow& row) {
  constexpr std::array verdicts{"failed", "out_of_reach", "unconfirmed", "stopped", "unfinished", "pending"};
  const auto found = std::ranges::find(verdicts, row.verdict);
  return found - verdicts.begin() + (found == verdicts.end() && row.reasons.empty() ? 1 : 0);
}

/// URL-encodes a folder name.
std::string in_link(const std::string& name) {
  std::string out;
  for (const char letter : name) {
    const auto byte = static_cast<unsigned char>(letter);
    out += std::isalnum(byte) || letter == '-' || letter == '_' || letter == '.' ? std::string(1, letter)
                                                                                 : format("%%%02X", byte);
  }
  return out;
}

std::string html_cell(const BatchRow& row, const std::string& column, const ordered_json& value) {
  const std::string what = column.substr(0, column.find('_'));
  if (value.is_number())
    return "<td class=\"number " + what + "\">" +
           (value.is_number_float() ? plain(value.get<double>(), 4) : value.dump()) + "</td>";
  std::string text = value.is_string() ? xml_text(one_line(value.get<std::string>())) : "";
  if (column == "study" && row.verdict != "pending")
    text = "<a href=\"" + in_link(row.study) + "/" + kPage + "\">" + text + "</a>";
  return "<td class=\"" + what + "\">" + text + "</td>";
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

std::string batch_page(const std::vector<BatchRow>& rows, const std::string& heading) {
  std::vector<BatchRow> sorted = rows;
  std::ranges::stable_sort(sorted, {}, [](const BatchRow& row) { return std::pair(rank_of(row), -row.error); });
  const auto columns = columns_of(rows);
  std::string head, body;
  see_cells({}, columns,
            [&](const std::string& name, const ordered_json&) { head += "<th>" + xml_text(name) + "</th>"; });
  for (const BatchRow& row : sorted) {
    const char* kind = row.verdict != "confirmed" ? "bad" : row.reasons.empty() ? "met" : "open";
    body += std::string("<tr class=\"") + kind + "\">";
    see_cells(row, columns,
              [&](const std::string& name, const ordered_json& value) { body += html_cell(row, name, value); });
    body += "</tr>\n";
  }
  return filled_in("batch/texts/batch.html", {{"heading", xml_text(one_line(heading))},
                                              {"count", xml_text(count_of(rows))},
                                              {"columns", head},
                                              {"rows", body}});
}

}  // namespace pastefit
