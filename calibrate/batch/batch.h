#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/study/study.h"
#include "core/result.h"

namespace pastefit {

struct BatchStudy {
  std::string name;              ///< unique in the batch; also the folder's name
  std::filesystem::path file;    ///< as the user named it
  std::filesystem::path folder;  ///< of card, page and store
  Study study;
};

/// Name of a study in a batch: its file name without suffix, or the folder's name for study.json, as written by
/// `pastefit new`.
std::string batch_name(const std::filesystem::path& file);

/// Reads the studies of a batch, with one result folder per study in `out`. Errors: every fault of all files; duplicate
/// names.
Result<std::vector<BatchStudy>> read_batch(const std::vector<std::string>& files, const std::filesystem::path& out);

/// Card in the folder, if it belongs to the present study and laboratory files.
std::optional<Card> card_of_batch(const BatchStudy& one);

/// True if the calibration is complete, with card and page. False if it was stopped by the user or the machine.
bool is_finished(const BatchStudy& one);

/// Reason why a calibration has no card.
struct BatchFailure {
  std::string status;  ///< as in a card, e.g. "failed"
  std::string reason;  ///< as text
};

inline const std::string kFailureFile = "failure.json";

/// Saves the failure in the study's folder, which is created if necessary. Errors: the folder cannot be written.
Faults write_failure(const BatchStudy& one, const BatchFailure& failure);
std::optional<BatchFailure> read_failure(const BatchStudy& one);

struct BatchRow {
  std::string study;
  /// "confirmed", "unconfirmed", "out_of_reach", "stopped", "failed" as in a card; "unfinished": no card yet;
  /// "pending": no simulations.
  std::string verdict;
  std::string reasons;  ///< why it is not confirmed, or reservations about the card
  double error = 0;     ///< largest error in tolerances, as far as known
  /// Columns with values, null if unknown, in groups: common to every study; those of laboratory files, readings and
  /// parameters, which differ between studies; and provenance.
  std::array<nlohmann::ordered_json, 5> columns;
};

/// Reads a study's folder. A missing or damaged folder is a verdict, too.
BatchRow row_of(const BatchStudy& one);

/// A row for each folder of a calibration in a folder, ordered by name, as `batch` and `calibrate --seeds` write them.
/// Empty if there is none, or if the folder itself is one of a calibration.
std::vector<BatchRow> rows_in(const std::filesystem::path& folder);

/// Table as comma-separated values, one row per study in the given order. Missing columns of a study are empty.
std::string batch_csv(const std::vector<BatchRow>& rows);

/// Table as self-contained HTML page without scripts: worst verdicts first, then largest errors. Each study is a link
/// to the page in its folder, relative to this page.
std::string batch_page(const std::vector<BatchRow>& rows, const std::string& heading = "Batch");

/// Batch as Slurm jobs.
struct ArrayJob {
  std::filesystem::path program;     ///< pastefit, absolute
  std::filesystem::path directory;   ///< working directory of the jobs, absolute; file names are relative to it
  std::filesystem::path out;         ///< folder of the results
  std::vector<std::string> studies;  ///< files, one per element
  int workers = 1;                   ///< cores per element
  int part = 1;                      ///< number of this array, if the batch needs several
};

/// Default limit of elements in Slurm (MaxArraySize 1001); administrators may change it.
inline constexpr std::size_t kMostElements = 1000;

/// Faults of names that scripts cannot contain: Slurm reads an option line to its end, and a backslash disables its
/// wildcards.
Faults unusable_in_job(const ArrayJob& job);

/// Script of the array job; each element calibrates one study. Elements are requeued two minutes before the time limit,
/// after a stop by Slurm or its node, and up to three times after a killed process; they continue where they stopped.
std::string array_job_script(const ArrayJob& job);

/// Script of the job that makes the table; to be started after the array.
std::string table_job_script(const ArrayJob& job);

}  // namespace pastefit
