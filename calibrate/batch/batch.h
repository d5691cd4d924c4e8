#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/study/study.h"
#include "core/result.h"

namespace pastefit {

/// One of many studies, and the folder of its calibration.
struct BatchStudy {
  std::string name;              ///< unique in the batch; also that of the folder
  std::filesystem::path file;    ///< as the user named it
  std::filesystem::path folder;  ///< of card, page and store
  Study study;
};

/// The name of a study in a batch: of its file without the suffix, or of the file's folder for a file study.json, as
/// `pastefit new` writes it.
std::string batch_name(const std::filesystem::path& file);

/// Reads the studies of a batch whose results go into `out`, one folder per study.
/// Errors: every fault of all files at once; two studies of one name.
Result<std::vector<BatchStudy>> read_batch(const std::vector<std::string>& files, const std::filesystem::path& out);

/// The card of the calibration, if the folder holds one of this study and its laboratory files as they are now.
std::optional<Card> card_of_batch(const BatchStudy& one);

/// Whether the calibration came to its end, with a card and its page, and need not be done again. One that the user or
/// the machine stopped did not.
bool is_finished(const BatchStudy& one);

/// Why a calibration ended without a card.
struct BatchFailure {
  std::string status;  ///< as in a card, e.g. "failed"
  std::string reason;  ///< in words
};

inline const std::string kFailureFile = "failure.json";

/// Keeps it in the study's folder, which is made if need be. Errors: the folder cannot be written.
Faults write_failure(const BatchStudy& one, const BatchFailure& failure);
std::optional<BatchFailure> read_failure(const BatchStudy& one);

/// A batch as jobs of Slurm.
struct ArrayJob {
  std::filesystem::path program;     ///< pastefit, absolute
  std::filesystem::path directory;   ///< in which the jobs run, absolute: names of files are relative to it
  std::filesystem::path out;         ///< folder of the results
  std::vector<std::string> studies;  ///< files, one per element
  int workers = 1;                   ///< cores of an element
  int part = 1;                      ///< of the arrays that one batch needs
};

/// Elements that an array has at most: Slurm's own limit (MaxArraySize 1001), where its administrator has set no other.
inline constexpr std::size_t kMostElements = 1000;

/// What no script can name: Slurm reads a line of options to its end, and a backslash as the end of its wildcards.
Faults unusable_in_job(const ArrayJob& job);

/// The script of the array job: an element calibrates one study. It is asked for again when Slurm or its node ends it,
/// two minutes before the time limit, and up to three times when its process is killed; then it goes on where it was.
std::string array_job_script(const ArrayJob& job);

/// The script of the job that makes the table, to be started when the array has ended.
std::string table_job_script(const ArrayJob& job);

}  // namespace pastefit
