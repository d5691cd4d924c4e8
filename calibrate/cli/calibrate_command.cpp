#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/calibrate.h"
#include "calibrate/card/standing.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/cli/understood.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/inference/description.h"
#include "calibrate/report/diagnosis.h"
#include "calibrate/report/findings.h"
#include "calibrate/report/page.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/store/program.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

struct CalibrateArguments {
  std::string study;
  std::string out;
  bool resume = false;
  bool force = false;
  bool json = false;
  bool dry_run = false;
  int threads = 0;
  int budget = 0;
  double wall_budget_s = 0, core_budget_s = 0;
  std::optional<std::uint64_t> seed;
  int seeds = 1;
  std::vector<std::string> settings;

  /// Words of the command that another run of it repeats; without the study, its folder and its seed.
  std::vector<std::string> repeated() const {
    std::vector<std::string> words;
    for (const std::string& one : settings) words.insert(words.end(), {"--set", one});
    if (threads > 0) words.insert(words.end(), {"--threads", std::to_string(threads)});
    return words;
  }

  /// The command, to which options may be added.
  std::string command() const {
    std::string line = "pastefit calibrate " + shell_word_if_needed(study) + " --out " + shell_word_if_needed(out);
    for (const std::string& word : repeated()) line += " " + shell_word_if_needed(word);
    return seed ? line + " --seed " + std::to_string(*seed) : line;
  }
};

/// Writes card, summary, curves and page of a calibration to its folder, and prints the result. Exit status: success
/// only for a confirmed material.
int deliver_material(const CalibrationResult& result, const Store& store, const OutputFolder& folder,
                     const CalibrateArguments& options, const std::atomic<bool>& stop, RunRecordings& seen) {
  const Card& card = *result.card;
  const auto summary = summary_of(card, result.inference ? describe(*result.inference) : "");
  const auto unwritten = write_card(folder, card, summary);
  print(options.json ? json_text(to_json(card)) : summary);
  if (!options.json && !is_quiet())  // not in the file: the commands are those of this folder
    print(next_step_lines(in_the_way(card), next_steps(card, options.command(), options.out)));
  refuse(unwritten, kFailed);
  std::vector<std::string> files{kCardFile, kSummary, kPage, kStore};
  refuse(write_looks(folder, findings_of(card, store, result.inference), stop,
                     {.threads = options.threads, .seen = &seen}, files),
         kFailed);
  for (const std::string& name : files) note("wrote %s\n", folder.file(name).c_str());
  return card.search.status == name_of(CalibrationStatus::confirmed) ? kDone : kFailed;
}

/// Prints the reason for a missing card; the page shows the results so far.
int say_why_not(const CalibrationResult& result, const Study& study, const Store& store, const OutputFolder& folder,
                const CalibrateArguments& options) {
  auto failures = nlohmann::ordered_json::object();
  std::fprintf(stderr, "pastefit: no material to report: %s\n", result.search.reason.c_str());
  for (const auto& [reason, count] : result.counts.failures) {
    const std::string name(name_of(reason));
    std::fprintf(stderr, "  %d simulations failed: %s\n", count, name.c_str());
    failures[name] = count;
  }
  std::fprintf(stderr, "The simulations are stored in %s.\n", folder.file(kStore).c_str());
  const std::string status(name_of(result.search.status));
  if (!is_quiet())
    std::fprintf(stderr, "%s",
                 next_step_lines("", next_steps_without_card(status, options.command(), options.study)).c_str());
  if (options.json)
    print(json_text({{"status", name_of(result.search.status)},
                     {"reason", result.search.reason},
                     {"simulations", result.search.simulations},
                     {"failures", failures}}));
  (void)write_page(folder.path(), findings_without_card(study, store));
  return kFailed;
}

Study study_to_calibrate(const CalibrateArguments& options) {
  Study study = value_or_throw(read_study_with(options.study, options.settings));
  if (options.budget > 0) study.search.budget_simulations = options.budget;
  if (options.seed) study.search.seed = *options.seed;
  return study;
}

/// Reasons why the study cannot be calibrated; those of an overridden value name the option.
Faults faults_of(const Study& study, const CalibrateArguments& options) {
  auto faults = in_file(validate(study, options.threads), options.study);
  for (Fault& fault : faults)
    if (options.budget > 0 && fault.where.ends_with("search.budget_simulations")) fault.where = "--budget";
  return faults;
}

/// A calibration of more than a day requires a time budget, `--resume` or `--force`.
Faults too_long_faults(const Study& study, const CalibrateArguments& options) {
  const bool asked_for = options.force || options.resume || options.wall_budget_s > 0 || options.core_budget_s > 0;
  return long_run_faults(options.study + ": search.budget_simulations",
                         format("%d simulations", study.search.budget_simulations), least_effort_s(study),
                         options.threads, asked_for, "larger grains, a smaller budget, a --wall-budget");
}

/// One study for each seed, in folders of their own that are free or may be continued.
std::vector<BatchStudy> studies_of(const Study& study, const CalibrateArguments& options) {
  std::vector<BatchStudy> all;
  for (int i = 0; i < options.seeds; ++i) {
    BatchStudy one{"", options.study, "", study};
    one.study.search.seed = study.search.seed + static_cast<std::uint64_t>(i);
    one.name = "seed-" + std::to_string(one.study.search.seed);
    one.folder = std::filesystem::path(options.out) / one.name;
    (void)value_or_throw(open_calibration_folder(one.folder, one.study, options.resume, options.force));
    all.push_back(std::move(one));
  }
  return all;
}

/// True if the search has confirmed a material, or used the present budget.
bool needs_nothing(const BatchStudy& one) {
  if (!is_finished(one)) return false;
  const Card card = *card_of_batch(one);
  return cause_unconfirmed(card).empty() || card.search.budget >= one.study.search.budget_simulations;
}

struct SeedCards {
  std::vector<CardFile> cards;
  std::vector<std::string> without;  ///< searches without a card, with the reason
};

SeedCards cards_of(const std::vector<BatchStudy>& all) {
  SeedCards out;
  for (const BatchStudy& one : all)
    if (auto card = card_of_batch(one))
      out.cards.push_back({one.name, std::move(*card)});
    else if (const auto failure = read_failure(one))
      out.without.push_back(one.name + ": " + failure->reason);
    else
      out.without.push_back(one.name + ": not finished; the same command with --resume goes on");
  return out;
}

void print_seeds(const SeedCards& found, bool json) {
  if (json) {
    auto out = comparison_json(found.cards);
    out["without_card"] = found.without;
    print(json_text(out));
    return;
  }
  if (found.cards.size() > 1) print(comparison_lines(found.cards));
  for (const std::string& one : found.without) print(wrapped("No card of " + one_line(one) + "\n"));
}

/// Searches with the study's seed and the following ones, each a process of its own with the folder seed-NUMBER, and
/// prints their cards side by side. Exit status: success if every material is confirmed.
int run_seeds(const Study& study, const CalibrateArguments& options) {
  std::vector<std::string> words = options.repeated();
  const auto add = [&](const char* option, const std::string& value) { words.insert(words.end(), {option, value}); };
  if (options.budget > 0) add("--budget", std::to_string(options.budget));
  if (options.wall_budget_s > 0) add("--wall-budget", exact(options.wall_budget_s));
  if (options.core_budget_s > 0) add("--core-budget", exact(options.core_budget_s));
  const std::atomic<bool>& stop = listen_for_stop();
  const std::vector<BatchStudy> all = studies_of(study, options);
  Faults faults;
  for (std::size_t i = 0; i < all.size() && !stop; ++i) {
    const bool finished = needs_nothing(all[i]);
    note("%zu of %zu: %s%s\n", i + 1, all.size(), all[i].name.c_str(), finished ? ": finished before" : "");
    if (finished) continue;
    std::vector<std::string> with_seed = words;
    with_seed.insert(with_seed.end(), {"--seed", std::to_string(all[i].study.search.seed)});
    append(faults, calibrate_in_child(all[i], with_seed, stop));
  }
  const SeedCards found = cards_of(all);
  print_seeds(found, options.json);
  refuse(faults, kFailed);
  const auto confirmed =
      std::ranges::count_if(found.cards, [](const CardFile& one) { return cause_unconfirmed(one.card).empty(); });
  if (!options.json) print("%td of %zu searches confirmed a material.\n", confirmed, all.size());
  return confirmed == std::ssize(all) ? kDone : kFailed;
}

int run_calibrate(const CalibrateArguments& options) {
  const Study study = study_to_calibrate(options);
  refuse(faults_of(study, options));
  refuse(too_long_faults(study, options));
  if (options.dry_run) {
    print("%s\n%s%sResults go to %s.\n", one_line(study.title).c_str(), understood(study, options.threads).c_str(),
          notes_on_readings(study).c_str(), printable(options.out).c_str());
    return kDone;
  }

  if (options.seeds > 1) return run_seeds(study, options);
  const std::atomic<bool>& stop = listen_for_stop();
  const OutputFolder folder =
      value_or_throw(open_calibration_folder(options.out, study, options.resume, options.force));
  const std::string file = folder.file(kStore);
  Store store = value_or_throw(Store::open(file, {program_identity(), inputs_of(study)}));
  refuse(strangers_in(study, store, file));

  print_remarks(study, store, file, options.threads);
  ProgressLine line(study);
  LivePage page(options.out);
  RunRecordings looks;
  const auto show = [&](const Progress& progress) {
    line.show(progress);
    if (progress.phase != "examination") page.show(study, store);
  };
  const auto count = [&](const EvaluationCounts& counts) { line.show(counts); };
  PoolOptions pool;
  pool.threads = options.threads;
  pool.wall_budget_s = options.wall_budget_s;
  pool.core_budget_s = options.core_budget_s;
  pool.stop = &stop;
  pool.pulse = [&] { line.look(); };
  pool.run_observer = &looks;
  auto calibrated = calibrate(study, store, pool, {show, count}, options.study);
  line.end();
  const auto result = value_or_throw(std::move(calibrated), kFailed);
  return result.card ? deliver_material(result, store, folder, options, stop, looks)
                     : say_why_not(result, study, store, folder, options);
}

}  // namespace

Command add_calibrate(CLI::App& verb) {
  const auto options = std::make_shared<CalibrateArguments>();
  verb.add_option("STUDY", options->study, "study file")->required();
  verb.add_option("--out", options->out,
                  "folder for card.json, summary.txt, " + kPage + " and " + kStore +
                      "; default: a folder beside STUDY with its name without .json")
      ->type_name("DIR");
  auto* resume = verb.add_flag("--resume", options->resume, "continue with the simulations stored in DIR");
  verb.add_flag("--force", options->force, "replace the earlier result in DIR; start even if it takes more than a day")
      ->excludes(resume);
  verb.add_flag("--json", options->json, "print the card instead of the summary");
  add_threads(verb, options->threads);
  verb.add_option("--budget", options->budget, "simulations in total, instead of the study's")
      ->type_name("N")
      ->check(whole_number(1, 1'000'000));
  verb.add_option("--wall-budget", options->wall_budget_s,
                  "end after this time with the best material so far; --resume continues")
      ->type_name("SECONDS")
      ->check(positive_number());
  verb.add_option("--core-budget", options->core_budget_s,
                  "the same for the processor time of all simulations together")
      ->type_name("SECONDS")
      ->check(positive_number());
  verb.add_option("--seed", options->seed, "seed of search and packings, instead of the study's")
      ->check(whole_number());
  verb.add_option("--seeds", options->seeds,
                  "searches with this and the following seeds, each in a folder seed-NUMBER of DIR; their cards are "
                  "then compared")
      ->type_name("N")
      ->check(whole_number(2, 1000));
  verb.add_option("--set", options->settings,
                  "PATH=VALUE, changes the study file's content for this calibration, e.g. "
                  "parameters.friction.upper=0.8 or search.seed=3; may be given again")
      ->type_name("PATH=VALUE")
      ->take_all();
  verb.add_flag("--dry-run", options->dry_run, "print the plan and the expected time, and end");
  return [options] {
    if (options->out.empty()) options->out = std::filesystem::path(options->study).replace_extension().string();
    return run_calibrate(*options);
  };
}

}  // namespace pastefit
