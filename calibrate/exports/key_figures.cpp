#include "calibrate/exports/key_figures.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "calibrate/base/input_file.h"
#include "calibrate/base/statistics.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

using FigureColumn = std::vector<double>;
using FigureTable = std::map<std::string, FigureColumn>;

const std::string kFigureFile = "figures.csv";

Result<FigureTable> read_table(const fs::path& file) {
  const std::string remedy = "the file that the deck in.application writes";
  const auto text = read_input(file, {256u << 20, remedy, ".csv"});
  if (!text.ok()) return text.faults();
  const auto lines = csv_lines(text.value(), ',');
  FigureTable table;
  if (lines.empty() || text.value().empty()) return Fault{file.string(), "is empty", remedy};
  const auto& names = lines[0].cells;
  if (std::set(names.begin(), names.end()).size() != names.size())
    return Fault{file.string(), "has a column twice", remedy};
  for (std::size_t n = 1; n < lines.size(); ++n) {
    if (lines[n].cells == std::vector<std::string>{""}) continue;  // at the end of the file
    const std::string place = file.string() + ", line " + std::to_string(lines[n].number);
    if (lines[n].cells.size() != names.size())
      return Fault{place, "has another number of cells than the heading", remedy};
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto number = written_number(lines[n].cells[k]);
      if (!number || !std::isfinite(number->value))
        return Fault{place, in_quotes(lines[n].cells[k]) + " is not a number", remedy};
      table[names[k]].push_back(number->value);
    }
  }
  for (const char* needed : {"time_s", "end_s", "fed_kg", "inside_kg"})
    if (table[needed].empty())
      return Fault{file.string(), "has no column " + std::string(needed) + " with numbers", remedy};
  const double last = table["time_s"].back(), end = table["end_s"].back();
  if (last < end - 0.05)
    return Fault{file.string(), "ends at " + shown(last) + " s of " + shown(end) + " s",
                 "let the deck finish; log.liggghts shows why it stopped"};
  return table;
}

/// Mean of a column over the rows of a window.
double mean_over(const FigureColumn& column, std::size_t first, std::size_t last) {
  return std::accumulate(column.begin() + static_cast<std::ptrdiff_t>(first),
                         column.begin() + static_cast<std::ptrdiff_t>(last) + 1, 0.0) /
         static_cast<double>(last - first + 1);
}

/// First row in which a column is at least this value; the last row if there is none.
std::size_t first_row(const FigureColumn& column, double least) {
  const auto found = std::ranges::find_if(column, [&](double value) { return value >= least; });
  return static_cast<std::size_t>(std::min(found, column.end() - 1) - column.begin());
}

using Figures = std::vector<std::pair<std::string, double>>;

Figures figures_of(FigureTable& table) {
  const FigureColumn& time = table["time_s"];
  FigureColumn out = table["fed_kg"];
  for (std::size_t n = 0; n < out.size(); ++n) out[n] -= table["inside_kg"][n];
  const double fed = table["fed_kg"].back(), left = std::fabs(out.back()) < 1e-9 * fed ? 0 : out.back();
  constexpr double least_share = 0.05;  // less is no discharge, but what splashes
  const bool discharges = left > least_share * fed && !table.contains("lost_kg");
  const std::size_t first = discharges ? first_row(out, 0.2 * left) : first_row(time, 0.5 * time.back());
  const std::size_t last = discharges ? std::max(first, first_row(out, 0.8 * left)) : time.size() - 1;
  const char* const gone = table.contains("lost_kg") ? "lost_kg" : "discharged_kg";
  Figures figures{{"fed_kg", fed}, {gone, left}, {"remaining_kg", fed - left}};
  if (discharges && time[last] > time[first])
    figures.emplace_back("discharge_rate_kg_s", (out[last] - out[first]) / (time[last] - time[first]));
  if (discharges && left >= 0.5 * fed) figures.emplace_back("time_to_50_percent_s", time[first_row(out, 0.5 * fed)]);
  for (const auto& entry : table) {
    const std::string& name = entry.first;
    const FigureColumn& column = entry.second;
    const auto mean_as = [&](std::string_view ending, const std::string& as, double factor = 1) {
      if (!name.ends_with(ending)) return;
      figures.emplace_back(name.substr(0, name.size() - ending.size()) + as, factor * mean_over(column, first, last));
    };
    mean_as("flow_depth_m", "flow_depth_mm", mm);
    mean_as("_force_n", "_force_mean_n");
    if (name.ends_with("_force_n"))
      figures.emplace_back(name.substr(0, name.size() - 2) + "_max_n", std::ranges::max(column));
    mean_as("_torque_n_m", "_torque_mean_n_m");
  }
  return figures;
}

/// Folders of an application: the folder itself, or its subfolders in the order of their names.
std::vector<fs::path> run_folders(const fs::path& folder) {
  std::error_code error;
  const auto is_run = [&](const fs::path& one) {
    return fs::exists(one / kFigureFile, error) || fs::exists(one / "in.application", error);
  };
  if (is_run(folder)) return {folder};
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_run(entry->path())) found.push_back(entry->path());
  std::ranges::sort(found);
  return found;
}

}  // namespace

double KeyFigure::mean() const {
  return sample_of(of_runs).mean;
}

std::optional<std::pair<double, double>> KeyFigure::band() const {
  const Sample sample = sample_of(of_runs);
  if (sample.count < 3) return std::nullopt;
  const boost::math::students_t distribution(sample.count - 1);
  const double half =
      boost::math::quantile(distribution, 0.95) * sample.standard_deviation * std::sqrt(1 + 1.0 / sample.count);
  return std::pair{sample.mean - half, sample.mean + half};
}

Result<KeyFigures> read_key_figures(const fs::path& folder) {
  KeyFigures found;
  Faults faults;
  std::vector<Figures> all;
  for (const fs::path& run : run_folders(folder)) {
    if (std::error_code error; !fs::exists(run / kFigureFile, error)) {
      faults.push_back({run.string(), "has not been run", "liggghts -in in.application there"});
      continue;
    }
    auto table = value_or_append(read_table(run / kFigureFile), faults);
    if (!table) continue;
    found.runs.push_back(run == folder ? "." : run.filename().string());
    all.push_back(figures_of(table.value()));
  }
  if (!faults.empty()) return faults;
  if (all.empty())
    return Fault{
        folder.string(), "has no " + kFigureFile + ", and no subfolder with it",
        "pastefit export CARD --to liggghts --application FILE --out DIR, then liggghts -in in.application in DIR"};
  for (const auto& [name, value] : all[0]) {
    KeyFigure figure{name, {}};
    for (const Figures& run : all)
      if (const auto same = std::ranges::find(run, name, &Figures::value_type::first); same != run.end())
        figure.of_runs.push_back(same->second);
    if (figure.of_runs.size() == all.size()) found.figures.push_back(std::move(figure));
  }
  return found;
}

}  // namespace pastefit
