#include "calibrate/batch/batch.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/report/findings.h"
#include "calibrate/report/page.h"
#include "calibrate/search/calibration.h"
#include "calibrate/store/program.h"

namespace pastefit {

namespace fs = std::filesystem;

std::string batch_name(const fs::path& file) {
  std::error_code error;
  if (file.stem() != "study") return file.stem().string();
  const fs::path folder = fs::absolute(file, error).lexically_normal().parent_path().filename();
  return folder.empty() ? "study" : folder.string();
}

Result<std::vector<BatchStudy>> read_batch(const std::vector<std::string>& files, const fs::path& out) {
  std::vector<BatchStudy> batch;
  std::map<std::string, std::string> first_of;
  Faults faults;
  for (const std::string& file : files) {
    const std::string name = batch_name(file);
    const auto [first, is_new] = first_of.emplace(name, file);
    if (name == "." || name == "..")
      faults.push_back({file, "has no name that a folder of the batch can have", "give the file another name"});
    if (!is_new)
      faults.push_back({file, "has the name \"" + name + "\" in this batch, as " + first->second + " has",
                        "give each study once, and each under another name of its file or folder"});
    auto study = read_study(file);
    if (!study.ok())
      for (const Fault& fault : study.faults()) faults.push_back(fault);
    else if (is_new)
      batch.push_back({name, file, out / name, std::move(study).value()});
  }
  if (!faults.empty()) return faults;
  return batch;
}

std::optional<Card> card_of_batch(const BatchStudy& one) {
  std::error_code error;
  const fs::path file = one.folder / kCardFile;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  auto card = read_card(file);
  if (!card.ok() || card.value().provenance.study_hash != one.study.hash) return std::nullopt;
  const auto same = [](const CardTest& test, const StudyTest& own) { return test.lab_hash == own.lab.hash; };
  const auto& tests = card.value().tests;
  const auto& own_tests = one.study.tests;
  if (!std::equal(tests.begin(), tests.end(), own_tests.begin(), own_tests.end(), same)) return std::nullopt;
  return std::move(card).value();
}

bool is_finished(const BatchStudy& one) {
  const auto card = card_of_batch(one);
  if (!card || card->search.status == name_of(CalibrationStatus::stopped)) return false;
  std::error_code no_page, no_card;
  const auto page = fs::last_write_time(one.folder / kPage, no_page);
  return !no_page && page >= fs::last_write_time(one.folder / kCardFile, no_card) && !no_card;
}

Faults write_failure(const BatchStudy& one, const BatchFailure& failure) {
  std::error_code error;
  fs::create_directories(one.folder, error);
  if (error)
    return {{one.folder.string(), "cannot be made: " + error.message(), "choose a folder that can be written"}};
  return write_atomically(one.folder / kFailureFile,
                          json_text({{"status", failure.status}, {"reason", failure.reason}}));
}

std::optional<BatchFailure> read_failure(const BatchStudy& one) {
  std::error_code error;
  if (!fs::is_regular_file(one.folder / kFailureFile, error)) return std::nullopt;
  Faults faults;
  const auto document = read_json(one.folder / kFailureFile, faults);
  if (!document || !document->is_object()) return std::nullopt;
  const auto text = [&](const char* key) {
    const auto found = document->find(key);
    return found != document->end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  return BatchFailure{text("status"), text("reason")};
}

namespace {

/// Beginning of both scripts.
std::string heading_of_job(const ArrayJob& job, const std::string& meaning, const std::string& name) {
  return "#!/bin/bash\n# " + meaning + " Written by pastefit " + program_version() +
         ".\n# Time limit, partition, account and memory: options of sbatch, or further #SBATCH lines.\n#SBATCH "
         "--job-name=" +
         name + "\n#SBATCH --chdir=" + shell_word(job.directory.string()) + "\n#SBATCH --nodes=1 --ntasks=1\n";
}

std::string studies_of(const ArrayJob& job) {
  std::string out = "studies=(\n";
  for (const std::string& study : job.studies) out += "  " + shell_word(study) + "\n";
  return out + ")\n";
}

/// Output option of Slurm, which replaces %a by the number of the element; % in the folder's name is doubled.
std::string output_line(const ArrayJob& job, const std::string& name) {
  std::string folder;
  for (const char letter : job.out.string()) folder += letter == '%' ? std::string("%%") : std::string(1, letter);
  return "#SBATCH --output=" + shell_word((std::filesystem::path(folder) / name).string()) + " --open-mode=append\n";
}

std::string output_of_part(int part) {
  return part == 1 ? "slurm-%a.txt" : "slurm-" + std::to_string(part) + "-%a.txt";
}

constexpr const char* kElement = R"sh(
driver=
requeue() { echo "$1: the element is queued again and continues where it was"; scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"; }
# Before the time limit, and where Slurm or a person ends the job, the calibration ends with all that it has simulated.
trap 'time_is_up=yes; kill -TERM $driver' USR1
trap 'kill -TERM $driver' TERM
)sh";

constexpr const char* kWait = R"sh(driver=$!
wait $driver; status=$?
while kill -0 $driver 2>/dev/null; do wait $driver; status=$?; done
if [ -n "$time_is_up" ]; then
  requeue "the time is up"
elif [ $status -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
  requeue "pastefit was killed (status $status)"
fi
exit $status
)sh";

}  // namespace

Faults unusable_in_job(const ArrayJob& job) {
  Faults faults;
  const auto check = [&](const std::string& where, const std::string& path, bool pattern) {
    const auto bad = [&](unsigned char letter) {
      return letter < 0x20 || letter == 0x7f || (pattern && letter == '\\');
    };
    if (std::ranges::any_of(path, bad))
      faults.push_back({where,
                        in_quotes(path) + " has a line break, a control character or a backslash, which no option "
                                          "of Slurm can have",
                        "a folder with another name"});
  };
  check("--out", job.out.string(), true);
  check("the working folder", job.directory.string(), false);
  return faults;
}

std::string array_job_script(const ArrayJob& job) {
  const std::string last = std::to_string(job.studies.size() - 1);
  return heading_of_job(job, "Calibrates one study per element.", "pastefit") + "#SBATCH --array=0-" + last +
         "\n#SBATCH --cpus-per-task=" + std::to_string(job.workers) + "\n#SBATCH --requeue --signal=B:USR1@120\n" +
         output_line(job, output_of_part(job.part)) + studies_of(job) + kElement + shell_word(job.program.string()) +
         " batch \"${studies[SLURM_ARRAY_TASK_ID]}\" --out " + shell_word(job.out.string()) +
         " --workers \"$SLURM_CPUS_PER_TASK\" --no-table &\n" + kWait;
}

std::string table_job_script(const ArrayJob& job) {
  return heading_of_job(job, "Makes the table of the studies.", "pastefit-table") + "#SBATCH --requeue\n" +
         output_line(job, "slurm-table.txt") + studies_of(job) + "exec " + shell_word(job.program.string()) +
         " batch \"${studies[@]}\" --out " + shell_word(job.out.string()) + " --table\n";
}

}  // namespace pastefit
