#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calibrate/batch/batch.h"

namespace pastefit {

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

}  // namespace pastefit
