// pastefit-front: error of the slump test's readings against run time, for a ladder of settings. See README.md.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "tests/bench/ladder_csv.h"
#include "tests/bench/phases.h"

using namespace pastefit;

namespace {

void print_row(const std::vector<Row>& rows, const Row& row) {
  const Row& reference = reference_of(rows, row);
  int failed = 0;
  double worst = 0;
  for (const Run& run : row.runs) {
    failed += !run.readings;
    worst = std::max(worst, std::fabs(run.energy_error));
  }
  std::printf("| %s | %s%s | %d | %.2e | %.2f |", row.setting.ladder.c_str(), row.setting.name.c_str(),
              &reference == &row ? " (reference)" : "", static_cast<int>(row.runs.size()), row.runs[0].time_step_s,
              cpu_of(row).value);
  if (failed == static_cast<int>(row.runs.size())) {
    std::printf(" all runs fail: %s | | | | |\n", row.runs[0].failure.c_str());
    return;
  }
  for (std::size_t k = 0; k < kReadings.size(); ++k) {
    const Mean mean = reading_of(row, k);
    if (&reference == &row) {
      std::printf(" %.1f +- %.1f |", mean.value, mean.error);
      continue;
    }
    const Deviation d = deviation(row, reference, k);
    std::printf(d.is_noise() ? " (%+.1f +- %.1f) |" : " **%+.1f +- %.1f** |", d.value, d.noise);
  }
  std::printf(" %.1e%s |\n", worst, failed > 0 ? ", some runs fail" : "");
}

void print_table(const std::vector<Row>& rows, const std::string& scene) {
  if (std::ranges::none_of(rows, [&](const Row& row) { return row.setting.scene == scene; })) return;
  std::printf("\n### %s\n\n| ladder | setting | packings | mean step [s] | processor time [s] |", scene.c_str());
  for (const char* name : kReadingNames) std::printf(" %s [mm] |", name);
  std::printf(" energy error |\n|---|---|---:|---:|---:|");
  for (std::size_t k = 0; k <= kReadings.size(); ++k) std::printf("---:|");
  std::printf("\n");
  for (const Row& row : rows)
    if (row.setting.scene == scene) print_row(rows, row);
}

void print_phases(int packings) {
  for (const char* scene : kScenes) {
    const std::vector<PhaseCost> phases = phases_of(scene, 0.010, packings);
    double all = 0;
    for (const PhaseCost& phase : phases)
      if (!phase.phase.starts_with("fill")) all += phase.cpu_s;
    std::printf("\n### %s\n\n| phase | simulated s | processor s | share of the test |\n|---|---:|---:|---:|\n", scene);
    for (const PhaseCost& phase : phases) {
      std::printf("| %s | %.2f | %.3f | ", phase.phase.c_str(), phase.simulated_s, phase.cpu_s);
      if (phase.phase.starts_with("fill"))
        std::printf("|\n");
      else
        std::printf("%.0f %% |\n", 100 * phase.cpu_s / all);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false, phases = false;
  std::string ladder, csv_path;
  int most_packings = 1000;
  CLI::App app{"Error of h1, h2, sag and spread of the slump test against run time."};
  app.add_flag("--quick", quick, "few coarse settings, to see that the program works");
  app.add_option("--ladder", ladder, "measure this one only")
      ->check(CLI::IsMember(std::vector<std::string>(kLadders.begin(), kLadders.end())));
  app.add_option("--packings", most_packings, "at most so many for each setting")->check(CLI::Range(1, 1000));
  app.add_option("--csv", csv_path, "file for one row per run; settings that it has already are not run again");
  app.add_flag("--phases", phases, "what each phase of the test takes, and nothing else");
  CLI11_PARSE(app, argc, argv);
  if (phases) {
    print_phases(std::min(most_packings, 8));
    return 0;
  }

  std::vector<Row> rows;
  std::ifstream file(csv_path);
  const std::string known{std::istreambuf_iterator<char>(file), {}};
  Fills fills;
  for (Setting setting : ladders(quick)) {
    setting.packings = std::min(setting.packings, most_packings);
    if (!ladder.empty() && setting.ladder != ladder) continue;
    std::istringstream before(known);
    Row row{setting, read_csv(before, setting)};
    if (static_cast<int>(row.runs.size()) < setting.packings) row = measure(setting, fills);
    rows.push_back(row);
    std::cerr << setting.scene << ", " << setting.ladder << ": " << setting.name << '\n';
    // Written after every row, so that a run cut short leaves what it has.
    if (!csv_path.empty()) {
      std::ofstream csv(csv_path);
      write_csv(csv, rows);
    }
  }
  std::printf(
      "Of a reference: mean +- standard error over packings. Else: deviation from it +- noise of the difference "
      "(one standard\nerror); in brackets where it is within twice the noise, which is no difference.\n");
  for (const char* scene : kScenes) print_table(rows, scene);
}
