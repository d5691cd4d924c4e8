#include "calibrate/batch/batch.h"

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/json_document.h"
#include "calibrate/base/text.h"
#include "calibrate/report/findings.h"
#include "calibrate/report/report_page.h"
#include "calibrate/search/calibration.h"

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
  if (card.value().tests.size() != one.study.tests.size()) return std::nullopt;
  for (std::size_t i = 0; i < one.study.tests.size(); ++i)
    if (card.value().tests[i].lab_hash != one.study.tests[i].lab.hash) return std::nullopt;
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

}  // namespace pastefit
