#include "calibrate/batch/batch.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/embedded_text.h"
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
    auto study = value_or_append(read_study(file), faults);
    if (study && is_new) batch.push_back({name, file, out / name, std::move(study).value()});
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

/// The script of a job, whose output goes to this file in the batch's folder.
std::string job_script(std::string_view text, const ArrayJob& job, const std::string& output) {
  std::string studies, folder;
  for (const std::string& study : job.studies) studies += "  " + shell_word(study) + "\n";
  // Slurm replaces %a by the number of the element; % in the folder's name is doubled.
  for (const char letter : job.out.string()) folder += letter == '%' ? std::string("%%") : std::string(1, letter);
  return filled_in(text, {{"version", program_version()},
                          {"directory", shell_word(job.directory.string())},
                          {"last", std::to_string(job.studies.size() - 1)},
                          {"workers", std::to_string(job.workers)},
                          {"output", shell_word((fs::path(folder) / output).string())},
                          {"studies", studies},
                          {"program", shell_word(job.program.string())},
                          {"out", shell_word(job.out.string())}});
}

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
  return job_script("batch/texts/array_job.sh", job,
                    job.part == 1 ? "slurm-%a.txt" : "slurm-" + std::to_string(job.part) + "-%a.txt");
}

std::string table_job_script(const ArrayJob& job) {
  return job_script("batch/texts/table_job.sh", job, "slurm-table.txt");
}

}  // namespace pastefit
