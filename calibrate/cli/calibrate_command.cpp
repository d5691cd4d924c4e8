#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/fault_text.h"
#include "calibrate/base/foreign_text.h"
#include "calibrate/base/format.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/calibrate.h"
#include "calibrate/card/calibration_card.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/effort_checks.h"
#include "calibrate/cli/interrupt.h"
#include "calibrate/cli/machine_options.h"
#include "calibrate/cli/option_checks.h"
#include "calibrate/cli/output_folder.h"
#include "calibrate/cli/progress_line.h"
#include "calibrate/cli/report_page.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/cli/understood.h"
#include "calibrate/inference/words.h"
#include "calibrate/report/curve_csv.h"
#include "calibrate/report/kept_views.h"
#include "calibrate/report/summary.h"
#include "calibrate/search/effort.h"
#include "calibrate/search/record.h"
#include "calibrate/search/search.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/rig.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

struct CalibrateArguments {
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

std::vector<std::string> fitted_readings(const Study& study) {
  std::vector<std::string> names;
  for (const auto& reading : readings_of(study))
    if (reading.weight > 0) names.push_back(reading.name);
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
    for (const std::string& note : test.lab.notes) out += test.lab_file + ": " + note + ".\n";
    for (const std::string& note : doubts_about(test.lab.test, test.lab.measurements).notes)
      out += test.lab_file + ": " + note + ".\n";
  }
  return out;
}

/// What the study weighs or allows of readings that the laboratory did not take.
std::string readings_not_measured(const Study& study) {
  std::string names;
  for (const StudyTest& test : study.tests)
    for (const std::string& name : test.not_measured) names += (names.empty() ? "" : ", ") + reading_name(test, name);
  return names.empty() ? "" : "Weights and tolerances of readings that were not taken are left out: " + names + ".\n";
}

/// The answer as JSON where there is no card to print.
nlohmann::ordered_json without_material(const CalibrationResult& result) {
  auto failures = nlohmann::ordered_json::object();
  for (const auto& [reason, count] : result.counts.failures) failures[std::string(name_of(reason))] = count;
  return {{"status", name_of(result.search.status)},
          {"reason", result.search.reason},
          {"simulations", result.search.simulations},
          {"failures", failures}};
}

/// Card, summary, curves and page, to the folder and to the person. Only a confirmed material is what was asked for.
/// Who interrupts gets the page with what was seen until then.
int deliver(const Card& card, const std::optional<Inference>& inference, const Store& store,
            const CalibrateArguments& options, const OutputFolder& folder, const std::atomic<bool>& stop,
            Looks& looks) {
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

/// The study with what the options say instead of its file.
Result<Study> study_to_calibrate(const CalibrateArguments& options) {
  auto read = read_study(options.study);
  if (!read.ok()) return read;
  SearchOptions& search = read.value().search;
  if (options.budget > 0) search.budget_simulations = options.budget;
  if (options.seed) search.seed = *options.seed;
  return read;
}

/// What keeps the study from being calibrated. What the option says instead of the file is the option's fault.
Faults faults_of(const Study& study, const CalibrateOptions& how, const CalibrateArguments& options) {
  auto faults = in_file(validate(study, how), options.study);
  for (Fault& fault : faults)
    if (options.budget > 0 && fault.where.ends_with("search.budget_simulations")) fault.where = "--budget";
  return faults;
}

/// A calibration of more than a day has to be asked for: by a budget of time, by going on with it, or by force.
Faults too_long_faults(const Study& study, const CalibrateArguments& options) {
  const bool asked_for = options.force || options.resume || options.wall_budget_s > 0 || options.core_budget_s > 0;
  return long_run_faults(options.study + ": search.budget_simulations",
                         format("%d simulations", study.search.budget_simulations), least_effort_s(study),
                         options.threads, asked_for, "larger grains, a smaller budget, a --wall-budget");
}

Result<OutputFolder> open_folder(const Study& study, const CalibrateArguments& options) {
  const auto earlier = options.force    ? EarlierResult::replace
                       : options.resume ? EarlierResult::resume
                                        : EarlierResult::refuse;
  const auto budget = static_cast<std::uintmax_t>(study.search.budget_simulations);
  auto folder = OutputFolder::open(options.out, results_of(study), earlier, kSpace + budget * kSpaceOfEvaluation);
  if (folder.ok() && options.force) folder.value().clear(results_of(study));
  return folder;
}

/// What a person is told before anything runs.
void say_what_is_known(const Study& study, const Store& store, const std::string& file, int threads) {
  note("%s\n%d free parameters, at most %d simulations, %zu known\n", one_line(study.title).c_str(), free_count(study),
       study.search.budget_simulations, store.size());
  for (const auto& remark : store.remarks()) note("%s: %s.\n", file.c_str(), remark.c_str());
  if (!is_quiet()) note("%s%s", understood(study, threads).c_str(), readings_not_measured(study).c_str());
  note("%s%s%s", notes_on_readings(study).c_str(), changes_in(study, store).c_str(),
       warning_before(free_count(study), prior_count(study), fitted_readings(study)).c_str());
}

WorkAhead work_ahead(const Study& study) {
  const SearchOptions& search = study.search;
  const int each = static_cast<int>(tests_of(study, false).size());
  return {search.budget_simulations, search.screening * each, search.confirmation_packings * each,
          search.examination_simulations * each + hold_out_simulations(study, search)};
}

/// What is said where no candidate could be simulated; the page has what was seen.
int say_why_not(const CalibrationResult& result, const Study& study, const Store& store, const std::string& file,
                const CalibrateArguments& options) {
  std::fprintf(stderr, "pastefit: no material to report: %s\n", result.search.reason.c_str());
  for (const auto& [reason, count] : result.counts.failures)
    std::fprintf(stderr, "  %d simulations failed: %s\n", count, std::string(name_of(reason)).c_str());
  std::fprintf(stderr, "The evaluations are kept in %s.\n", file.c_str());
  if (options.json) print("%s", json_text(without_material(result)).c_str());
  (void)write_page(options.out, findings_without_card(study, store));
  return kFailed;
}

int run_calibrate(const CalibrateArguments& options) {
  const auto read = study_to_calibrate(options);
  if (!read.ok()) return report(read.faults());
  const Study& study = read.value();
  CalibrateOptions how{options.study, options.threads, options.wall_budget_s, options.core_budget_s, nullptr};
  if (const auto faults = faults_of(study, how, options); !faults.empty()) return report(faults);

  if (const auto faults = too_long_faults(study, options); !faults.empty()) return report(faults);

  const std::atomic<bool>& stop = listen_for_stop();
  how.stop = &stop;
  const auto folder = open_folder(study, options);
  if (!folder.ok()) return report(folder.faults());
  const std::string file = folder.value().file(kStore);
  auto store = Store::open(file, {program_identity(), inputs_of(study)});
  if (!store.ok()) return report(store.faults());
  if (const auto faults = strangers_in(study, store.value(), file); !faults.empty()) return report(faults);

  say_what_is_known(study, store.value(), file, options.threads);
  ProgressLine line(work_ahead(study), misfit_unit_of(study));
  LivePage page(options.out);
  Looks looks;
  const auto show = [&](const Progress& progress) {
    line.show(progress);
    if (progress.phase != "examination") page.show(study, store.value());
  };
  const auto count = [&](const EvaluationCounts& counts) { line.show(counts); };
  const auto result = calibrate(study, store.value(), how, {show, count, &looks});
  line.end();
  if (!result.ok()) return report(result.faults(), kFailed);
  if (!result.value().card) return say_why_not(result.value(), study, store.value(), file, options);
  return deliver(*result.value().card, result.value().inference, store.value(), options, folder.value(), stop, looks);
}

}  // namespace

Command add_calibrate(CLI::App& verb) {
  const auto options = std::make_shared<CalibrateArguments>();
  verb.add_option("STUDY", options->study, "study file")->required();
  verb.add_option("--out", options->out, "folder for " + kCard + ", " + kSummary + ", " + kPage + " and " + kStore)
      ->required()
      ->type_name("DIR");
  auto* resume = verb.add_flag("--resume", options->resume, "go on with the evaluations that DIR holds");
  verb.add_flag("--force", options->force, "replace the earlier result in DIR; compute for more than a day")
      ->excludes(resume);
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
  return [options] { return run_calibrate(*options); };
}

}  // namespace pastefit
