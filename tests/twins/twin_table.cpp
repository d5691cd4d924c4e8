#include "tests/twins/twin_table.h"

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <sstream>

#include "calibrate/base/text.h"

namespace pastefit {

namespace {

constexpr double allowed_miss = 2;  // standard errors
constexpr double allowed_lead_error = 0.05;

std::string share(std::size_t part, std::size_t whole) {
  if (whole == 0) return "-";
  return format("%.0f %% (%zu of %zu)", 100.0 * static_cast<double>(part) / static_cast<double>(whole), part, whole);
}

template <class Values>
double median_of(Values values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return static_cast<double>(values[values.size() / 2]);
}

}  // namespace

void write_head(std::ostream& csv, const Study& study) {
  csv << "twin,status,simulations,wall_s,determined,lead,lead_error,lead_held";
  for (std::size_t m = 0; m < study.tests[0].lab.measurements.size(); ++m)
    if (study.tests[0].targets[m].weight > 0) csv << ',' << study.tests[0].lab.measurements[m].reading << ".miss";
  for (const Parameter& parameter : study.parameters)
    if (parameter.free)
      for (const char* what : {"truth", "recommended", "lower", "upper", "lower_known", "upper_known"})
        csv << ',' << parameter.name << '.' << what;
  csv << ",end\n" << std::flush;
}

void write_row(std::ostream& csv, const TwinResult& result) {
  csv << result.number << ',' << result.status << ',' << result.simulations << ','
      << format("%.1f,%d,", result.wall_s, result.determined) << result.lead << ','
      << format("%.4f,%d", result.lead_error, result.lead_held);
  for (const double miss : result.misses) csv << format(",%.3f", miss);
  for (const TwinParameter& one : result.parameters)
    csv << format(",%.6g,%.6g,%.6g,%.6g,%d,%d", one.truth, one.recommended, one.lower, one.upper, one.lower_known,
                  one.upper_known);
  csv << ",end\n" << std::flush;
}

std::map<int, TwinResult> read_table(std::istream& csv) {
  std::map<int, TwinResult> rows;
  std::string line, cell;
  std::vector<std::string> head;
  while (std::getline(csv, line)) {
    std::vector<std::string> cells;
    for (std::istringstream in(line); std::getline(in, cell, ',');) cells.push_back(cell);
    if (cells.empty() || cells.back() != "end") continue;
    if (head.empty()) {
      head = cells;
      continue;
    }
    TwinResult row;
    row.number = std::stoi(cells[0]);
    row.status = cells[1];
    if (cells.size() > 8) {
      row.simulations = std::stoi(cells[2]);
      row.wall_s = std::stod(cells[3]);
      row.determined = std::stoi(cells[4]);
      row.lead = cells[5];
      row.lead_error = std::stod(cells[6]);
      row.lead_held = cells[7] == "1";
    }
    std::size_t first = 8;
    for (; first + 1 < cells.size() && head[first].ends_with(".miss"); ++first)
      row.misses.push_back(std::stod(cells[first]));
    for (std::size_t i = first; i + 6 < cells.size(); i += 6)
      row.parameters.push_back({head[i].substr(0, head[i].find('.')), std::stod(cells[i]), std::stod(cells[i + 1]),
                                std::stod(cells[i + 2]), std::stod(cells[i + 3]), cells[i + 4] == "1",
                                cells[i + 5] == "1"});
    rows.emplace(row.number, std::move(row));
  }
  return rows;
}

void write_report(std::ostream& out, const std::vector<TwinResult>& results, const std::string& title) {
  struct Tally {
    std::size_t known = 0, covered = 0, covered_at_all = 0, count = 0;
    std::vector<double> width;
  };
  std::vector<std::pair<std::string, Tally>> tallies;
  Tally all;
  std::size_t judged = 0, confirmed = 0, matched = 0, readings = 0, readings_matched = 0;
  std::size_t determined = 0, close = 0, as_stated = 0;
  std::vector<double> simulations, errors;
  for (const TwinResult& result : results) {
    if (result.parameters.empty()) continue;
    ++judged;
    confirmed += result.status == "confirmed" ? 1 : 0;
    matched += result.worst_miss() <= allowed_miss ? 1 : 0;
    readings += result.misses.size();
    for (const double miss : result.misses) readings_matched += miss <= allowed_miss ? 1 : 0;
    simulations.push_back(result.simulations);
    if (result.determined > 0) {
      ++determined;
      errors.push_back(result.lead_error);
      close += result.lead_error <= allowed_lead_error ? 1 : 0;
      as_stated += result.lead_held ? 1 : 0;
    }
    for (const TwinParameter& one : result.parameters) {
      auto tally = std::ranges::find(tallies, one.name, &std::pair<std::string, Tally>::first);
      if (tally == tallies.end()) tally = tallies.insert(tallies.end(), {one.name, {}});
      const bool inside = one.truth >= one.lower && one.truth <= one.upper;
      for (Tally* each : {&tally->second, &all}) {
        ++each->count;
        each->covered_at_all += inside ? 1 : 0;
        if (!one.lower_known && !one.upper_known) continue;
        ++each->known;
        each->covered += inside ? 1 : 0;
        if (one.lower_known && one.upper_known && one.lower > 0)
          each->width.push_back(100 * (std::sqrt(one.upper / one.lower) - 1));
      }
    }
  }
  out << "# " << title << "\n\n" << results.size() << " twins, " << judged << " of them calibrated.\n\n";
  out << "| claim | asked | found |\n|---|---|---|\n";
  out << "| confirmed within the tolerance | - | " << share(confirmed, judged) << " |\n";
  out << "| fitted readings within 2 standard errors of the laboratory's mean | 95 % | "
      << share(readings_matched, readings) << " |\n";
  out << "| twins with all of them there | - | " << share(matched, judged) << " |\n";
  out << "| best determined combination within 5 % of the truth | 90 % | " << share(close, determined) << " |\n";
  out << "| that, in the 95 % interval that the calibration states of it | 95 % | " << share(as_stated, determined)
      << " |\n";
  out << "| 95 % intervals with an end that hold the truth | 90 to 99 % | " << share(all.covered, all.known) << " |\n";
  out << format("\nMedian error of the best determined combination: %.1f %%. Median of simulations %.0f.\n\n",
                100 * median_of(errors), median_of(simulations));
  out << "| parameter | has an interval | of those, hold the truth | median half width of a closed one | named as not "
         "identified |\n|---|---|---|---|---|\n";
  for (const auto& [name, tally] : tallies)
    out << "| `" << name << "` | " << share(tally.known, tally.count) << " | " << share(tally.covered, tally.known)
        << " | " << (tally.width.empty() ? "-" : format("%.0f %%", median_of(tally.width))) << " | "
        << share(tally.count - tally.known, tally.count) << " |\n";
  out << "\nTwins that were not calibrated: ";
  std::string none = "none";
  for (const TwinResult& result : results)
    if (result.parameters.empty()) {
      out << (none.empty() ? "; " : "") << result.number << " (" << result.status << ")";
      none.clear();
    }
  out << none << ".\n";
}

}  // namespace pastefit
