// pastefit-bench: speed and memory of the engine, of a test and of a calibration, side by side with other engines.
// See README.md.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/machine.h"
#include "core/step/kernels.h"
#include "tests/bench/speed/report.h"
#include "tests/bench/speed/roofline.h"

using namespace pastefit;

namespace {

constexpr int kDone = 0, kNoAnswer = 1, kBadInput = 2;

int refuse(const Faults& faults) {
  for (const Fault& fault : faults)
    std::fprintf(stderr, "pastefit-bench: %s: %s; %s\n", fault.where.c_str(), fault.what.c_str(), fault.remedy.c_str());
  return kBadInput;
}

struct Asked {
  std::vector<std::string> scenes;
  std::vector<int> steps;
  MeasureOptions options;
  bool scaling = false, roofline = false;
  std::string json, csv, against;
};

Faults validate(const Asked& asked) {
  Faults faults;
  for (const std::string& scene : asked.scenes)
    for (const Fault& fault : validate_scene(scene)) faults.push_back(fault);
  if (asked.scenes.empty() && !asked.scaling && !asked.roofline)
    faults.push_back({"SCENE", "nothing to measure", "name scenes, or give --scaling or --roofline; see --help"});
  if (asked.steps.size() > 1 && asked.steps.size() != asked.scenes.size())
    faults.push_back(
        {"--steps",
         std::to_string(asked.steps.size()) + " numbers for " + std::to_string(asked.scenes.size()) + " scenes",
         "give one number, or one for each scene"});
  for (const int steps : asked.steps)
    if (steps < 1) faults.push_back({"--steps", std::to_string(steps), "give a number of at least 1"});
  if (asked.options.repeats < 1)
    faults.push_back({"--repeats", std::to_string(asked.options.repeats), "give a number of at least 1"});
  return faults;
}

int run(const Asked& asked) {
  // The answer for programs may go to standard output; what a person reads then goes to standard error.
  std::FILE* const person = asked.json == "-" ? stderr : stdout;
  const auto show = [&](const std::string& text) {
    std::fputs(text.c_str(), person);
    std::fflush(person);
  };
  std::vector<SceneResult> results;
  const auto take = [&](const std::string& scene, MeasureOptions options) {
    results.push_back(measure(scene, options));
    show(table_of(results.back()));
  };
  for (std::size_t k = 0; k < asked.scenes.size(); ++k) {
    MeasureOptions options = asked.options;
    if (!asked.steps.empty()) options.steps = asked.steps[asked.steps.size() == 1 ? 0 : k];
    take(asked.scenes[k], options);
  }
  if (asked.scaling) {
    const std::size_t first = results.size();
    MeasureOptions options = asked.options;
    options.peers = false;
    for (const char* box : {"box-1k", "box-10k", "box-100k", "box-1m"}) take(box, options);
    show(scaling_table({results.begin() + static_cast<std::ptrdiff_t>(first), results.end()}));
  }
  nlohmann::ordered_json json = json_of(results);
  if (asked.roofline) {
    const Roofline roofline = measure_roofline();
    show(table_of(roofline));
    json["roofline"] = json_of(roofline);
  }

  Faults faults;
  if (asked.json == "-")
    std::printf("%s\n", json.dump(2).c_str());
  else if (!asked.json.empty())
    faults = write_atomically(asked.json, json.dump(2) + "\n");
  if (!asked.against.empty())
    for (const Comparison& comparison : compared_with(asked.against, results)) show(sentence_of(comparison) + "\n");
  if (!asked.csv.empty()) {
    for (const Comparison& comparison : compared_with(asked.csv, results))
      if (is_slow_down(comparison))
        std::fprintf(stderr, "pastefit-bench: slower: %s\n", sentence_of(comparison).c_str());
    for (const Fault& fault : append_csv(asked.csv, results)) faults.push_back(fault);
  }
  if (!faults.empty()) {
    refuse(faults);
    return kNoAnswer;
  }
  for (const SceneResult& r : results)
    if (!r.ours().measured()) return kNoAnswer;
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();  // as the program does
  Asked asked;
  CLI::App app{"Measures speed and memory, side by side with other engines.", "pastefit-bench"};
  std::string scenes = "scenes:";
  for (const std::string& name : measurable_scenes()) scenes += " " + name;
  app.add_option("SCENE", asked.scenes, scenes);
  app.add_flag("--peers", asked.options.peers, "also run LAMMPS, LIGGGHTS and Yade where they are installed");
  app.add_option("--steps", asked.steps, "timed steps: one number for all scenes, or one for each");
  app.add_option("--repeats", asked.options.repeats, "runs of every engine, in turn; the median counts (3)");
  app.add_option("--patience", asked.options.patience_s, "an engine that took longer is not run again [s] (60)");
  app.add_flag("--energy-balance", asked.options.energy_balance,
               "our engine keeps its energy balance where steps are timed, as `pastefit simulate` does; no peer does");
  std::vector<std::string> sets;
  for (const KernelTable* table : kernels_this_processor_runs()) sets.emplace_back(table->instruction_set);
  app.add_option("--kernels", asked.options.kernels, "instruction set of our engine's kernels where steps are timed")
      ->transform(CLI::IsMember(sets, CLI::ignore_case, [](std::string name) {
        std::erase(name, '-');
        return name;
      }));
  app.add_flag("--scaling", asked.scaling, "boxes of 1,000 to 1,000,000 grains: cost of a grain's step");
  app.add_flag("--roofline", asked.roofline, "bytes and operations of a contact against what the machine can do");
  app.add_option("--json", asked.json, "file for the results; -: standard output");
  app.add_option("--against", asked.against, "file of --csv: says how many times as long ours takes as its last line")
      ->check(CLI::ExistingFile);
  app.add_option("--csv", asked.csv, "file to which a line for each engine is added; slow-downs are reported");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  if (const Faults faults = validate(asked); !faults.empty()) return refuse(faults);
  try {
    return run(asked);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "pastefit-bench: %s\n", problem.what());
    return kNoAnswer;
  }
}
