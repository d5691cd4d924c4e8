#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/exports/key_figures.h"

namespace pastefit {

namespace {

struct KpiOptions {
  std::string folder;
  bool json = false;
};

std::string figure_table(const KeyFigures& found) {
  std::string out = format("%-30s %9s %20s  %s\n", "Key figure", "mean", "90 % of materials", "each");
  for (const KeyFigure& one : found.figures) {
    const auto band = one.band();
    const std::string range = band ? plain(band->first) + " to " + plain(band->second) : "";
    out += format("%-30s %9s %20s  ", one.name.c_str(), plain(one.mean()).c_str(), range.c_str()) +
           listed(
               one.of_runs, [](double value) { return plain(value); }, " ") +
           "\n";
  }
  return out + format("%zu runs: ", found.runs.size()) + one_line(listed(found.runs)) + "\n";
}

nlohmann::ordered_json figures_json(const KeyFigures& found) {
  nlohmann::ordered_json out{{"runs", found.runs}, {"figures", nlohmann::ordered_json::object()}};
  for (const KeyFigure& one : found.figures) {
    nlohmann::ordered_json& row = out["figures"][one.name];
    row = {{"mean", one.mean()}, {"of_runs", one.of_runs}};
    if (const auto band = one.band()) row["band_90_percent"] = {band->first, band->second};
  }
  return out;
}

}  // namespace

Command add_kpi(CLI::App& verb) {
  const auto options = std::make_shared<KpiOptions>();
  verb.add_option("DIR", options->folder, "folder of an application that has been run, or of several materials in it")
      ->required();
  verb.add_flag("--json", options->json, "print the figures as JSON");
  return [options] {
    const KeyFigures found = value_or_throw(read_key_figures(options->folder));
    print("%s", (options->json ? json_text(figures_json(found)) : figure_table(found)).c_str());
    return kDone;
  };
}

}  // namespace pastefit
