#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/batch/batch.h"
#include "calibrate/calibrate.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/evaluate/cost.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

struct BatchArguments {
  std::vector<std::string> studies;
  std::string out;
  int workers = 0;
  bool table = false;     ///< only the table of existing results
  bool no_table = false;  ///< for an array element; another job writes the table
  bool slurm = false;     ///< write scripts only
  bool force = false;
};

constexpr int kElementWorkers = 4;  // default number of cores of an array element
const std::string kBatchTable = "batch.csv", kBatchPage = "batch.html";
const std::string kArrayScript = "batch.sbatch", kTableScript = "batch-table.sbatch";

/// Reasons why studies cannot be calibrated, of all studies together.
Faults unfit_studies(const std::vector<BatchStudy>& batch, const BatchArguments& options) {
  Faults faults;
  for (const BatchStudy& one : batch) {
    const int threads = options.slurm ? 1 : options.workers;  // memory is that of this machine, not of the cluster
    const bool asked_for = options.force || is_finished(one);
    Faults found = in_file(validate(one.study, threads), one.file);
    if (found.empty())
      found = long_run_faults(one.file.string() + ": search.budget_simulations",
                              format("%d simulations", one.study.search.budget_simulations), least_effort_s(one.study),
                              options.workers, asked_for, "larger grains, a smaller budget");
    append(faults, std::move(found));
  }
  return faults;
}

void write_table(const std::vector<BatchRow>& rows, const fs::path& out) {
  std::error_code error;
  fs::create_directories(out, error);
  refuse(write_atomically(out / kBatchTable, batch_csv(rows)), kFailed);
  refuse(write_atomically(out / kBatchPage, batch_page(rows)), kFailed);
  note("wrote %s\nwrote %s\n", (out / kBatchTable).c_str(), (out / kBatchPage).c_str());
}

/// Calibrates the unfinished studies one after the other.
Faults calibrate_all(const std::vector<BatchStudy>& batch, const BatchArguments& options,
                     const std::atomic<bool>& stop) {
  std::vector<std::string> words;
  if (options.workers > 0) words = {"--threads", std::to_string(options.workers)};
  Faults all;
  for (std::size_t i = 0; i < batch.size() && !stop; ++i) {
    const BatchStudy& one = batch[i];
    const bool finished = is_finished(one);
    note("%zu of %zu: %s%s\n", i + 1, batch.size(), one.name.c_str(), finished ? ": finished before" : "");
    if (finished) continue;
    append(all, calibrate_in_child(one, words, stop));  // continue with the next study
    const BatchRow row = row_of(one);
    print("%s: %s%s%s\n", one.name.c_str(), row.verdict.c_str(), row.reasons.empty() ? "" : ": ", row.reasons.c_str());
    std::fflush(stdout);
  }
  return all;
}

int run_on_this_machine(const std::vector<BatchStudy>& batch, const BatchArguments& options) {
  const std::atomic<bool>& stop = listen_for_stop();
  const Faults faults = options.table ? Faults{} : calibrate_all(batch, options, stop);
  std::vector<BatchRow> rows;
  for (const BatchStudy& one : batch) rows.push_back(row_of(one));
  if (!options.no_table) write_table(rows, options.out);
  if (stop) std::fprintf(stderr, "pastefit: interrupted; the same command continues\n");
  const auto confirmed = std::ranges::count(rows, "confirmed", &BatchRow::verdict);
  if (!options.no_table) print("%td of %zu studies are confirmed\n", confirmed, rows.size());
  refuse(faults, kFailed);
  const bool whole = std::ranges::all_of(batch, is_finished);  // including the page
  return options.table || (whole && confirmed == std::ssize(rows)) ? kDone : kFailed;
}

/// Scripts of the arrays of the batch, by name: Slurm limits the number of elements.
std::vector<std::pair<std::string, std::string>> array_scripts(const ArrayJob& whole) {
  std::vector<std::pair<std::string, std::string>> out;
  for (std::size_t begin = 0; begin < whole.studies.size(); begin += kMostElements) {
    ArrayJob part = whole;
    const auto first = whole.studies.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto count = std::min(kMostElements, whole.studies.size() - begin);
    part.studies.assign(first, first + static_cast<std::ptrdiff_t>(count));
    part.part = static_cast<int>(out.size()) + 1;
    const std::string name = out.empty() ? kArrayScript : format("batch-%d.sbatch", part.part);
    out.emplace_back(name, array_job_script(part));
  }
  return out;
}

/// Writes the scripts, and prints the commands that submit them.
int write_jobs(const BatchArguments& options) {
  std::error_code error;
  const ArrayJob job{fs::read_symlink("/proc/self/exe", error), fs::current_path(error), options.out, options.studies,
                     options.workers > 0 ? options.workers : kElementWorkers};
  refuse(unusable_in_job(job));
  const fs::path out = options.out, table = out / kTableScript;
  fs::create_directories(out, error);
  std::string submitted;
  for (const auto& [name, script] : array_scripts(job)) {
    refuse(write_atomically(out / name, script), kFailed);
    note("wrote %s\n", (out / name).c_str());
    submitted += ":$(sbatch --parsable " + shell_word((out / name).string()) + ")";
  }
  refuse(write_atomically(table, table_job_script(job)), kFailed);
  note("wrote %s\n", table.c_str());
  note("to run them with %d cores each, and then make the table:\n", job.workers);
  print("sbatch --dependency=afterany%s %s\n", submitted.c_str(), shell_word(table.string()).c_str());
  return kDone;
}

int run_batch(const BatchArguments& options) {
  auto batch = read_batch(options.studies, options.out);
  Faults faults = batch.ok() ? unfit_studies(batch.value(), options) : batch.faults();
  append(faults, output_folder_faults("--out", options.out));
  refuse(faults);
  return options.slurm ? write_jobs(options) : run_on_this_machine(batch.value(), options);
}

}  // namespace

Command add_batch(CLI::App& verb) {
  const auto options = std::make_shared<BatchArguments>();
  verb.add_option("STUDIES", options->studies, "study files")->required();
  verb.add_option("--out", options->out, "folder for " + kBatchTable + ", " + kBatchPage + " and one folder per study")
      ->required()
      ->type_name("DIR");
  verb.add_option("--workers", options->workers,
                  "simulations at the same time; default: one per processor. With --slurm: cores per element of the "
                  "array; default: " +
                      std::to_string(kElementWorkers))
      ->type_name("N")
      ->check(whole_number(1, 100'000));
  auto* slurm = verb.add_flag("--slurm", options->slurm, "simulate nothing, write a Slurm array job: " + kArrayScript);
  auto* table = verb.add_flag("--table", options->table, "simulate nothing, make the table of the present results");
  table->excludes(slurm);
  verb.add_flag("--no-table", options->no_table, "make no table (for the elements of an array job)")
      ->excludes(table)
      ->excludes(slurm);
  verb.add_flag("--force", options->force, "start even if a study takes more than a day");
  return [options] { return run_batch(*options); };
}

}  // namespace pastefit
