#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/slump_sheet.h"
#include "calibrate/study/target_laws.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

struct PlanArguments {
  std::string folder = "plan";
  Sheet sheet;
  int budget = 60, packings = 4, threads = 0;
  bool force = false, json = false;
};

/// The expected readings as a sheet; without a density, that of the preset.
Sheet expected_sheet(const PlanArguments& options) {
  Sheet sheet = options.sheet;
  if (sheet.readings.empty())
    refuse({{"--slump", "is missing, and every other reading", "what you expect, e.g. --slump 100"}});
  const Test test = value_or_throw(apparatus_of(sheet.mould, options.folder));
  if (sheet.density.empty()) sheet.density = exact(specimen_of(test).bulk_density_kg_m3);
  if (sheet.target.empty()) sheet.target = target_laws().front().target;
  sheet.title = "Expected, before any measurement";
  sheet.source = "expected, not measured";
  return sheet;
}

/// Writes the files of the expected test. Returns the study's file.
fs::path write_expected(const PlanArguments& options) {
  const Sheet sheet = expected_sheet(options);
  const StartingFiles files = value_or_throw(starting_files(sheet, options.folder));
  const fs::path folder = options.folder, lab = folder / "lab.json";
  fs::path study = folder / "study.json";
  Faults faults = output_folder_faults(folder.string(), folder);
  std::error_code error;
  for (const fs::path& file : {lab, study})
    if (faults.empty() && fs::exists(file, error))
      append(faults, output_file_faults(file.string(), file, options.force));
  refuse(std::move(faults));
  fs::create_directories(folder, error);
  refuse(write_atomically(lab, files.lab), kFailed);
  refuse(write_atomically(study, files.study), kFailed);
  return study;
}

/// Frees the frictions within their plausible ranges: what they do to a heap is what a further reading may tell.
std::vector<std::string> freed_frictions(const Study& study) {
  std::vector<std::string> words;
  for (const PlausibleRange& range : plausible_ranges())
    for (const Parameter& one : study.parameters)
      if (one.name == range.name && !one.free && has_parameter(specimen_of(study.tests[0].lab.test).contact, one.name))
        words.insert(words.end(), {"--set", "parameters." + one.name + "={\"free\": [" + exact(range.smallest) + ", " +
                                                exact(range.largest) + "]}"});
  return words;
}

/// Runs a verb of this program. Refuses if it could not be run, or found its input unusable.
std::string output_of(const std::string& verb, std::vector<std::string> words, const PlanArguments& options,
                      const std::atomic<bool>& stop) {
  words.insert(words.begin(), verb);
  if (options.threads > 0) words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  if (options.force) words.push_back("--force");
  ChildEnd end;
  try {
    end = run_this_program(words, stop);
  } catch (const std::system_error& failed) {
    refuse({{"pastefit " + verb, std::string("no process could be started: ") + failed.what(), "close other programs"}},
           kFailed);
  }
  if (end.signal != 0 || (end.status != kDone && end.status != kFailed) || stop)
    refuse({{"pastefit " + verb, "did not end with a result", "see above; the files are in " + options.folder}},
           kFailed);
  return end.output;
}

int run_plan(const PlanArguments& options) {
  const fs::path study = write_expected(options);
  const std::string out = (study.parent_path() / "out").string();
  const std::atomic<bool>& stop = listen_for_stop();
  std::vector<std::string> calibrate{study.string(), "--out",    out,
                                     "--json",       "--budget", std::to_string(options.budget)};
  for (std::string& word : freed_frictions(value_or_throw(read_study(study)))) calibrate.push_back(std::move(word));
  note("Materials with these readings:\n");
  (void)output_of("calibrate", calibrate, options, stop);
  std::vector<std::string> predict{out, "--packings", std::to_string(options.packings)};
  if (options.json) predict.push_back("--json");
  note("What they leave in each test:\n");
  print(output_of("predict", predict, options, stop));
  return kDone;
}

}  // namespace

Command add_plan(CLI::App& verb) {
  const auto options = std::make_shared<PlanArguments>();
  Sheet& sheet = options->sheet;
  sheet.target.clear();
  verb.add_option("DIR", options->folder, "folder for the expected test and its materials (plan)");
  verb.add_option("--mould", sheet.mould, "mould of the expected test, as for pastefit new")
      ->type_name("MOULD")
      ->required();
  verb.add_option("--density", sheet.density, "of the fresh material; default: the preset's")->type_name("DENSITY");
  for (const ShortReading& one : short_readings())
    verb.add_option_function<std::string>(
            "--" + std::string(one.name),
            [&sheet, &one](const std::string& text) {
              if (!text.empty()) sheet.readings.emplace_back(one.name, text);
            },
            "expected " + std::string(one.meaning))
        ->type_name("VALUES");
  verb.add_option("--grains", sheet.grains, "radius of the grains, as for pastefit new")->type_name("RADII");
  verb.add_option("--budget", options->budget, "simulations to find the materials")
      ->type_name("N")
      ->check(whole_number(1, 1'000'000))
      ->capture_default_str();
  verb.add_option("--packings", options->packings, "heaps of each material in each test")
      ->check(whole_number(2, 1000))
      ->capture_default_str();
  add_threads(verb, options->threads);
  verb.add_flag("--force", options->force, "replace an earlier plan in DIR; compute for more than a day");
  verb.add_flag("--json", options->json, "print the ranking as JSON");
  return [options] { return run_plan(*options); };
}

}  // namespace pastefit
