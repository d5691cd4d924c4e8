#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/evaluate/evaluator.h"
#include "calibrate/report/misfit_figure.h"
#include "calibrate/search/comparison.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

struct CompareOptions {
  std::string study;
  std::string out;
  std::vector<std::string> strategies;
  int seeds = 1;
  int budget = 0;
  int judge_packings = 8;
  int threads = 0;
  bool resume = false;
  bool force = false;
  bool json = false;
};

const std::string kTrials = "comparison.csv";
const std::string kCourse = "course.csv";
const std::string kFigure = "comparison.svg";
const std::vector<std::string> kComparison = with_store({kTrials, kCourse, kFigure});
constexpr std::uint64_t kFirstJudge = 1'000'000'001;  // packings far from those of any search

std::string trials_csv(const std::vector<StrategyTrial>& trials, const ErrorUnit& unit) {
  std::string out = std::string("strategy,seed,status,simulations,failures,judged_misfit_") + unit.name() + "\n";
  for (const auto& trial : trials)
    out += format("%s,%llu,%s,%d,%d,", trial.strategy.c_str(), static_cast<unsigned long long>(trial.seed),
                  std::string(name_of(trial.status)).c_str(), trial.simulations, trial.failures) +
           (trial.judged >= 0 ? format("%.4g", unit.of(trial.judged)) : "") + "\n";
  return out;
}

std::string course_of(const std::vector<StrategyTrial>& trials, const ErrorUnit& unit) {
  std::string out = std::string("strategy,seed,simulations,misfit_") + unit.name() + "\n";
  for (const auto& trial : trials)
    for (std::size_t i = 0; i < trial.errors.size(); ++i)
      if (trial.errors[i] >= 0 && (i == 0 || trial.errors[i] != trial.errors[i - 1]))
        out += format("%s,%llu,%zu,%.4g\n", trial.strategy.c_str(), static_cast<unsigned long long>(trial.seed), i + 1,
                      unit.of(trial.errors[i]));
  return out;
}

void print_comparison(const std::vector<StrategySummary>& rows, const ErrorUnit& unit) {
  print("%-22s %10s %12s %18s %12s\n", "strategy", "confirmed", "simulations",
        unit.tolerance_mm ? "judged misfit mm" : "judged misfit", unit.tolerance_mm ? "worst mm" : "worst");
  for (const auto& row : rows) {
    print("%-22s %6d of %d %12.0f", row.strategy.c_str(), row.confirmed, row.trials, row.simulations);
    if (row.judged >= 0)
      print(" %18.2f %12.2f\n", unit.of(row.judged), unit.of(row.worst_judged));
    else
      print(" %18s %12s\n", "-", "-");
  }
  print(
      "Medians over the seeds; confirmed: within %s on packings that the search\n"
      "had not seen; judged on others, the same for all.\n",
      unit.tolerance_mm ? unit.words(1, "%g").c_str() : "the tolerances");
}

/// The same, in the words of the table.
nlohmann::ordered_json comparison_json(const std::vector<StrategySummary>& rows, const ErrorUnit& unit) {
  auto out = nlohmann::ordered_json::array();
  const auto judged = [&](double miss) { return miss >= 0 ? nlohmann::ordered_json(unit.of(miss)) : nullptr; };
  const std::string name = std::string("judged_misfit_") + unit.name();
  for (const auto& row : rows)
    out.push_back({{"strategy", row.strategy},
                   {"trials", row.trials},
                   {"confirmed", row.confirmed},
                   {"simulations", row.simulations},
                   {name, judged(row.judged)},
                   {"worst_" + name, judged(row.worst_judged)}});
  return {{"strategies", out}};
}

/// The strategies that were asked for, or all that can search so many parameters.
Result<std::vector<std::string>> strategies_of(const CompareOptions& options, SearchOptions search, int parameters,
                                               int tests) {
  Faults faults;
  std::vector<std::string> names = options.strategies;
  if (names.empty())
    for (const auto name : strategy_names()) names.emplace_back(name);
  std::vector<std::string> able;
  for (const auto& name : names) {
    search.strategy = name;
    const auto found = validate(search, parameters, tests);
    if (found.empty()) able.push_back(name);
    for (const auto& fault : found) {
      const bool its_own = fault.where == "search.strategy";
      const bool known = std::ranges::any_of(faults, [&](const Fault& one) { return one.what == fault.what; });
      if (!known && (!its_own || !options.strategies.empty())) faults.push_back(fault);
    }
  }
  if (!faults.empty()) return faults;
  return able;
}

/// What is to be compared. Errors: the study, or the strategies that were asked for, cannot be.
Result<ComparisonOptions> comparison_of(const CompareOptions& options, const Study& study) {
  if (auto faults = validate_memory(study, options.threads); !faults.empty()) return faults;
  ComparisonOptions comparison;
  comparison.search = study.search;
  if (options.budget > 0) comparison.search.budget_simulations = options.budget;
  comparison.seeds = options.seeds;
  auto strategies =
      strategies_of(options, comparison.search, free_count(study), static_cast<int>(tests_of(study, false).size()));
  if (!strategies.ok()) return strategies.faults();
  comparison.strategies = std::move(strategies).value();
  for (int k = 0; k < options.judge_packings; ++k)
    comparison.judge_packings.push_back(kFirstJudge + static_cast<std::uint64_t>(k));
  return comparison;
}

Result<OutputFolder> comparison_folder(const CompareOptions& options) {
  const auto earlier = options.force    ? EarlierResult::replace
                       : options.resume ? EarlierResult::resume
                                        : EarlierResult::refuse;
  auto folder = OutputFolder::open(options.out, kComparison, earlier, kSpace);
  if (folder.ok() && options.force) folder.value().clear(kComparison);
  return folder;
}

/// Runs the trials, and says of each how it ended.
std::vector<StrategyTrial> run_trials(const CompareOptions& options, const ComparisonOptions& comparison,
                                      const Study& study, Store& store) {
  const ErrorUnit unit = error_unit_of(study);
  const auto& stop = listen_for_stop();
  const auto objective = [&](int budget) -> std::unique_ptr<Objective> {
    EvaluatorOptions evaluator;
    evaluator.threads = options.threads;
    evaluator.budget = budget;
    evaluator.stop = &stop;
    return std::make_unique<SimulationObjective>(study, store, evaluator);
  };
  return compare_strategies(objective, comparison, [&](const StrategyTrial& trial) {
    note("%-22s seed %-4llu %-12s %4d simulations, %d failed, judged %s\n", trial.strategy.c_str(),
         static_cast<unsigned long long>(trial.seed), std::string(name_of(trial.status)).c_str(), trial.simulations,
         trial.failures, trial.judged >= 0 ? unit.words(trial.judged, "%.2f").c_str() : "-");
  });
}

/// The table, its course and its figure.
Faults write_comparison(const OutputFolder& folder, const std::vector<StrategyTrial>& trials,
                        const std::vector<StrategySummary>& rows, const Study& study) {
  const ErrorUnit unit = error_unit_of(study);
  const std::vector<std::pair<std::string, std::string>> files{{kTrials, trials_csv(trials, unit)},
                                                               {kCourse, course_of(trials, unit)},
                                                               {kFigure, misfit_figure(rows, unit, study.title)}};
  for (const auto& [name, content] : files) {
    if (auto faults = write_atomically(folder.file(name), content); !faults.empty()) return faults;
    note("wrote %s\n", folder.file(name).c_str());
  }
  return {};
}

int compare(const CompareOptions& options) {
  const auto read = read_study(options.study);
  if (!read.ok()) return report(read.faults());
  const auto& study = read.value();
  const auto comparison = comparison_of(options, study);
  if (!comparison.ok()) return report(in_file(comparison.faults(), options.study));
  const auto folder = comparison_folder(options);
  if (!folder.ok()) return report(folder.faults());
  auto store = Store::open(folder.value().file(kStore), {program_identity(), inputs_of(study)});
  if (!store.ok()) return report(store.faults());
  for (const auto& remark : store.value().remarks()) note("pastefit: %s: %s\n", kStore.c_str(), remark.c_str());

  const auto trials = run_trials(options, comparison.value(), study, store.value());
  if (trials.empty()) {
    std::fprintf(stderr, "pastefit: stopped before the first strategy was through; go on with --resume\n");
    return kFailed;
  }
  const auto asked = comparison.value().strategies.size() * static_cast<std::size_t>(options.seeds);
  const bool all = trials.size() == asked;
  if (!all) std::fprintf(stderr, "pastefit: stopped before all strategies were through; go on with --resume\n");
  const auto rows = summary_of(trials);
  const ErrorUnit unit = error_unit_of(study);
  if (options.json)
    print("%s", json_text(comparison_json(rows, unit)).c_str());
  else
    print_comparison(rows, unit);
  if (const auto faults = write_comparison(folder.value(), trials, rows, study); !faults.empty())
    return report(faults, kFailed);
  return all ? kDone : kFailed;
}

}  // namespace

Command add_compare_optimisers(CLI::App& verb) {
  const auto options = std::make_shared<CompareOptions>();
  verb.add_option("STUDY", options->study, "study file")->required();
  verb.add_option("--out", options->out, "folder for " + kTrials + ", " + kCourse + ", " + kFigure + " and " + kStore)
      ->required()
      ->type_name("DIR");
  verb.add_option("--strategies", options->strategies, "names, separated by commas; default: all")
      ->delimiter(',')
      ->type_name("NAMES");
  verb.add_option("--seeds", options->seeds, "trials of each strategy; default: 1")
      ->type_name("N")
      ->check(whole_number(1, 1000));
  verb.add_option("--budget", options->budget, "simulations of each trial, instead of the study's")
      ->type_name("N")
      ->check(whole_number(1, 1'000'000));
  verb.add_option("--judge-packings", options->judge_packings, "on which every result is judged; default: 8")
      ->type_name("N")
      ->check(whole_number(1, 1000));
  verb.add_flag("--json", options->json, "print the table as JSON");
  add_threads(verb, options->threads);
  auto* resume = verb.add_flag("--resume", options->resume, "go on with the evaluations that DIR holds");
  verb.add_flag("--force", options->force, "replace the earlier result in DIR")->excludes(resume);
  return [options] { return compare(*options); };
}

}  // namespace pastefit
