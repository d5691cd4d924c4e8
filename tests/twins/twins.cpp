// Twin laboratories: materials drawn over a study's box, tested by simulation, calibrated as a laboratory's would be,
// and compared with the truth. README.md says how to run it and what the figures mean.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "calibrate/base/text.h"
#include "tests/twins/twin_table.h"

using namespace pastefit;

int main(int argc, char** argv) {
  TwinRecipe recipe;
  int twins = 50, first = 0, budget = 0;
  double radius_mm = 0, truth_radius_mm = 0, tolerance_mm = 0, minutes = 1e9;
  std::string study_file, folder, report_file;
  PoolOptions options;
  CLI::App app{"Twin laboratories: known materials, calibrated and compared with the truth."};
  app.add_option("STUDY", study_file, "study whose box, apparatus and readings the twins have")->required();
  app.add_option("--out", folder, "folder for twins.csv and the evaluations; twins that it has are not made again")
      ->required();
  app.add_option("--report", report_file, "file for the report; otherwise it is printed");
  app.add_option("--twins", twins, "how many")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--first", first, "number of the first")->capture_default_str()->check(CLI::NonNegativeNumber);
  app.add_option("--seed", recipe.seed, "of truths, packings and ruler")->capture_default_str();
  app.add_option("--repeats", recipe.repeats, "of the twin's test")->capture_default_str()->check(CLI::Range(2, 100));
  app.add_option("--radius-mm", radius_mm, "mean one of the grains of the calibration, instead of the study's");
  app.add_option("--truth-radius-mm", truth_radius_mm,
                 "mean one of the grains of the twin, instead of the calibration's");
  app.add_option("--budget", budget, "simulations of a calibration, instead of the study's");
  app.add_option("--tolerance-mm", tolerance_mm, "of the confirmation, instead of the study's");
  app.add_option("--threads", options.threads, "simulations at the same time; default: one for each core");
  app.add_option("--minutes", minutes, "no twin starts after this time");
  CLI11_PARSE(app, argc, argv);

  auto read = read_study(study_file);
  if (!read.ok()) {
    std::cerr << message_of(read.faults()) << '\n';
    return 2;
  }
  Study study = std::move(read).value();
  if (study.tests.size() > 1) {
    std::cerr << study_file << ": has several tests; a twin is made of a study of one\n";
    return 2;
  }
  if (radius_mm > 0) {
    GrainSizes& grains = specimen_of(study.tests[0].lab.test).grains;
    grains = enlarged(grains, radius_mm / 1000 / grains.radius_m);
  }
  if (budget > 0) study.search.budget_simulations = budget;
  if (tolerance_mm > 0) study.search.tolerance_mm = tolerance_mm;
  recipe.truth_radius_m = truth_radius_mm / 1000;

  std::filesystem::create_directories(folder);
  const std::filesystem::path table = std::filesystem::path(folder) / "twins.csv";
  std::ifstream before(table);
  const std::map<int, TwinResult> known = read_table(before);
  const bool fresh = !std::filesystem::exists(table) || std::filesystem::file_size(table) == 0;
  std::ofstream csv(table, std::ios::app);
  if (fresh) write_head(csv, study);

  const auto start = std::chrono::steady_clock::now();
  std::vector<TwinResult> results;
  for (int number = first; number < first + twins; ++number) {
    if (const auto done = known.find(number); done != known.end()) {
      results.push_back(done->second);
      continue;
    }
    if (std::chrono::duration<double, std::ratio<60>>(std::chrono::steady_clock::now() - start).count() > minutes)
      break;
    const auto twin = make_twin(study, recipe, number, options);
    TwinResult result;
    result.number = number;
    result.status = "no twin";
    if (twin.ok())
      result = calibrate_twin(twin.value(),
                              std::filesystem::path(folder) / ("twin-" + std::to_string(number) + ".sqlite"), options);
    write_row(csv, result);
    std::printf("twin %d: %s, %d simulations, %.0f s\n", number, result.status.c_str(), result.simulations,
                result.wall_s);
    std::fflush(stdout);
    results.push_back(std::move(result));
  }
  std::ofstream file(report_file);
  write_report(report_file.empty() ? std::cout : file, results, study.title);
  return 0;
}
