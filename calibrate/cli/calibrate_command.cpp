#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/foreign_text.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/card/calibration_card.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/interrupt.h"
#include "calibrate/cli/machine_options.h"
#include "calibrate/cli/option_checks.h"
#include "calibrate/cli/output_folder.h"
#include "calibrate/cli/progress_line.h"
#include "calibrate/cli/report_page.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/inference/examination.h"
#include "calibrate/inference/words.h"
#include "calibrate/report/curve_csv.h"
#include "calibrate/report/kept_views.h"
#include "calibrate/report/summary.h"
#include "calibrate/search/coarse_rung.h"
#include "calibrate/search/evaluator.h"
#include "calibrate/search/memory.h"
#include "calibrate/search/record.h"
#include "calibrate/search/strategy.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/rig.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

struct CalibrateOptions {
  std::string study;
  std::string out;
  bool resume = false;
  bool force = false;
  bool json = false;
  int threads = 0;
  int budget = 0;
  double wall_budget_s = 0, core_budget_s = 0;
  std::optional<std::uint64_t> seed;
};

const std::string kCard = "card.json";
const std::string kSummary = "summary.txt";
constexpr std::uintmax_t kSpaceOfEvaluation = 8u << 10;  // its row, twice: in the log and in the table

/// The files of an earlier result.
std::vector<std::string> results_of(const Study& study) {
  std::vector<std::string> files{kCard, kSummary, kPage, kViewsFile};
  for (const StudyTest& test : study.tests) files.push_back(curve_file(test.name));
  return with_store(std::move(files));
}

std::vector<std::string> names_of(const std::vector<StudyReading>& readings, bool fitted_only) {
  std::vector<std::string> names;
  for (const auto& reading : readings)
    if (!fitted_only || reading.weight > 0) names.push_back(reading.name);
  return names;
}

std::vector<std::string> free_names(const Study& study) {
  std::vector<std::string> names;
  for (const auto& parameter : study.parameters)
    if (parameter.free) names.push_back(parameter.name);
  return names;
}

int prior_count(const Study& study) {
  return static_cast<int>(
      std::ranges::count_if(study.parameters, [](const Parameter& parameter) { return parameter.prior.has_value(); }));
}

std::string changed_places(const Store& store) {
  std::string out;
  for (const auto& place : store.changes()) out += (out.empty() ? "" : ", ") + place;
  return out;
}

/// A store of which nothing is of the study's tests: going on would mix two laboratories in one folder.
Faults strangers_in(const Study& study, const Store& store, const std::string& file) {
  if (store.size() == 0 || holding(study, store) > 0) return {};
  return {{file,
           "none of its " + std::to_string(store.size()) +
               " evaluations is of a test of this study; changed: " + changed_places(store),
           "resume with the apparatus, the grains and the density as they were; or choose another output folder, or "
           "start anew with --force"}};
}

/// What has changed since the evaluations were made, and how many of them still hold.
std::string changes_in(const Study& study, const Store& store) {
  if (store.changes().empty()) return "";
  return "Changed since the last run: " + changed_places(store) + ". " +
         std::to_string(earlier_of(study, store).size()) +
         " candidates are known from before within the present bounds; they do not count in the budget.\n";
}

/// What the laboratories' readings look like, taken together.
std::string notes_on_readings(const Study& study) {
  std::string out;
  for (const StudyTest& test : study.tests) {
    if (!test.lab.note.empty()) out += test.lab_file + ": " + test.lab.note + ".\n";
    for (const std::string& note : doubts_about(test.lab.test, test.lab.measurements).notes)
      out += test.lab_file + ": " + note + ".\n";
  }
  return out;
}

/// Card, summary, curves and page, to the folder and to the person. Only a confirmed material is what was asked for.
/// Who interrupts gets the page with what was seen until then.
int deliver(const Card& card, const std::optional<Inference>& inference, const Store& store,
            const CalibrateOptions& options, const OutputFolder& folder, const std::atomic<bool>& stop, Looks& looks) {
  const auto summary = summary_of(card, inference ? words_of(*inference) : "");
  auto faults = write_atomically(folder.file(kCard), json_text(to_json(card)));
  if (faults.empty()) faults = write_atomically(folder.file(kSummary), summary);
  print("%s", options.json ? json_text(to_json(card)).c_str() : summary.c_str());
  std::vector<std::string> files{kCard, kSummary, kPage, kStore};
  if (faults.empty()) {
    Findings findings = findings_of(card, store, inference);
    faults = look_at_tests(findings, options.out, stop, {.threads = options.threads, .seen = &looks});
    if (faults.empty()) faults = write_curves(options.out, findings, files);
    if (faults.empty()) faults = write_page(options.out, findings);
  }
  if (!faults.empty()) return report(faults, kFailed);
  for (const std::string& name : files) note("wrote %s\n", folder.file(name).c_str());
  return card.search.status == name_of(CalibrationStatus::confirmed) ? kDone : kFailed;
}

int calibrate(const CalibrateOptions& options) {
  const auto read = read_study(options.study);
  if (!read.ok()) return report(read.faults());
  const auto& study = read.value();
  auto search_options = study.search;
  if (options.budget > 0) search_options.budget_simulations = options.budget;
  if (options.seed) search_options.seed = *options.seed;
  auto for_the_search = search_options;
  for_the_search.budget_simulations -= hold_out_simulations(study, search_options);
  const auto fitted_tests = static_cast<int>(tests_of(study, false).size());
  if (auto faults = validate(for_the_search, free_count(study), fitted_tests); !faults.empty()) {
    faults = in_file(std::move(faults), options.study);
    // What the option says instead of the file is the option's fault.
    for (Fault& fault : faults)
      if (options.budget > 0 && fault.where.ends_with("search.budget_simulations")) fault.where = "--budget";
    return report(faults);
  }

  if (const auto faults = validate_memory(study, options.threads); !faults.empty())
    return report(in_file(faults, options.study));
  const Study coarse_study = with_coarse_grains(study);
  if (search_options.coarse_first) {
    const auto why = [&](std::size_t test) { return why_of_that_size(study.tests[test].lab.test); };
    const auto fitted = tests_of(study, false);
    if (std::ranges::none_of(fitted, [&](std::size_t test) { return why(test).empty(); }))
      return report({{options.study + ": search.coarse_first", std::string(why(fitted.front())), "leave it out"}});
    const std::vector<double> middle(static_cast<std::size_t>(free_count(study)), 0.5);
    for (const StudyTest& test : coarse_study.tests)
      if (const auto faults = validate_in_file_words(test_with(test.lab.test, values_at(coarse_study, middle), 1));
          !faults.empty())
        return report({{options.study + ": search.coarse_first", "with coarse grains: " + faults.front().what,
                        "leave it out, or take smaller grains"}});
  }

  const std::atomic<bool>& stop = listen_for_stop();
  const auto budget = search_options.budget_simulations;
  const auto earlier = options.force    ? EarlierResult::replace
                       : options.resume ? EarlierResult::resume
                                        : EarlierResult::refuse;
  auto folder = OutputFolder::open(options.out, results_of(study), earlier,
                                   kSpace + static_cast<std::uintmax_t>(budget) * kSpaceOfEvaluation);
  if (!folder.ok()) return report(folder.faults());
  if (options.force) folder.value().clear(results_of(study));
  auto store = Store::open(folder.value().file(kStore), {program_identity(), inputs_of(study)});
  if (!store.ok()) return report(store.faults());
  if (const auto faults = strangers_in(study, store.value(), folder.value().file(kStore)); !faults.empty())
    return report(faults);

  note("%s\n%d free parameters, at most %d simulations, %zu known\n", one_line(study.title).c_str(), free_count(study),
       budget, store.value().size());
  for (const auto& remark : store.value().remarks())
    note("%s: %s.\n", folder.value().file(kStore).c_str(), remark.c_str());
  note("%s%s%s", notes_on_readings(study).c_str(), changes_in(study, store.value()).c_str(),
       warning_before(free_count(study), prior_count(study), names_of(readings_of(study), true)).c_str());
  const int each = static_cast<int>(tests_of(study, false).size());
  const int examination = search_options.examination_simulations * each + hold_out_simulations(study, search_options);
  ProgressLine line({budget, search_options.screening * each, search_options.confirmation_packings * each, examination},
                    misfit_unit_of(study));
  LivePage page(options.out);
  EvaluatorOptions evaluator;
  evaluator.threads = options.threads;
  evaluator.budget = budget;
  evaluator.wall_budget_s = options.wall_budget_s;
  evaluator.core_budget_s = options.core_budget_s;
  evaluator.stop = &stop;
  evaluator.observer = [&](const EvaluationCounts& counts) { line.show(counts); };
  Looks looks;
  evaluator.onlooker = &looks;
  SimulationObjective objective(study, store.value(), evaluator);
  evaluator.observer = {};
  evaluator.onlooker = nullptr;
  SimulationObjective coarse(coarse_study, store.value(), evaluator);
  const auto calibration = search(
      objective, for_the_search,
      [&](const Progress& progress) {
        line.show(progress);
        page.show(study, store.value());
      },
      names_of(readings_of(study), false), free_names(study), search_options.coarse_first ? &coarse : nullptr);
  const bool found = calibration.best.point.size() > 0 && !calibration.best.failed;
  std::optional<Inference> inference;
  if (found) line.show(Progress{"examination", 0, budget, calibration.best.miss, ""});
  if (found) predict_hold_outs(study, calibration, objective);
  // Readings that no material meets say nothing of the parameters; and who interrupts does not want to wait.
  if (found && calibration.status != CalibrationStatus::out_of_reach && !stop)
    inference = examine(study, objective, store.value(), calibration, search_options.examination_simulations,
                        search_options.seed);
  line.end();

  if (const auto faults = objective.store_faults(); !faults.empty()) return report(faults, kFailed);
  const auto counts = objective.counts();
  if (!found) {
    std::fprintf(stderr, "pastefit: no material to report: %s\n", calibration.reason.c_str());
    for (const auto& [reason, count] : counts.failures)
      std::fprintf(stderr, "  %d simulations failed: %s\n", count, std::string(name_of(reason)).c_str());
    std::fprintf(stderr, "The evaluations are kept in %s.\n", folder.value().file(kStore).c_str());
    (void)write_page(options.out, findings_without_card(study, store.value()));
    return kFailed;
  }
  auto card = card_of(study, calibration, search_options, store.value(), counts, options.study);
  if (inference) card.inference = card_inference(*inference);
  return deliver(card, inference, store.value(), options, folder.value(), stop, looks);
}

}  // namespace

Command add_calibrate(CLI::App& verb) {
  const auto options = std::make_shared<CalibrateOptions>();
  verb.add_option("STUDY", options->study, "study file")->required();
  verb.add_option("--out", options->out, "folder for " + kCard + ", " + kSummary + ", " + kPage + " and " + kStore)
      ->required()
      ->type_name("DIR");
  auto* resume = verb.add_flag("--resume", options->resume, "go on with the evaluations that DIR holds");
  verb.add_flag("--force", options->force, "replace the earlier result in DIR")->excludes(resume);
  verb.add_flag("--json", options->json, "print the card instead of the summary");
  add_threads(verb, options->threads);
  verb.add_option("--budget", options->budget, "simulations in all, instead of the study's")
      ->type_name("N")
      ->check(whole_number(1, 1'000'000));
  verb.add_option("--wall-budget", options->wall_budget_s, "end after this time with the best so far; --resume goes on")
      ->type_name("SECONDS")
      ->check(positive_number());
  verb.add_option("--core-budget", options->core_budget_s,
                  "the same for the processor time of all simulations together")
      ->type_name("SECONDS")
      ->check(positive_number());
  verb.add_option("--seed", options->seed, "seed of the search and its packings, instead of the study's")
      ->check(whole_number());
  return [options] { return calibrate(*options); };
}

}  // namespace pastefit
