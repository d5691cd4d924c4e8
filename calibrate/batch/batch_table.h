#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calibrate/batch/batch.h"

namespace pastefit {

/// What is known of one study of a batch.
struct BatchRow {
  std::string study;
  /// "confirmed", "unconfirmed", "out_of_reach", "stopped", "failed" as in a card; "unfinished": there is no card yet;
  /// "pending": nothing was simulated.
  std::string verdict;
  std::string reasons;  ///< why it is not confirmed, and what speaks against a card, in words
  double error = 0;     ///< largest error in tolerances, as far as it is known
  /// Columns with their values, null where they are not known: of every study; then, which some studies have and others
  /// have not, its laboratory files, readings and parameters; and what made it.
  std::array<nlohmann::ordered_json, 5> columns;
};

/// What the study's folder tells. A folder that is not there or damaged is a verdict, too.
BatchRow row_of(const BatchStudy& one);

/// The table as comma-separated values, one row per study in the order given. A column that some study has and another
/// has not is empty there.
std::string batch_csv(const std::vector<BatchRow>& rows);

/// The table as one page of HTML that asks nothing of a network and runs no script, the worst verdicts on top, and of
/// these the largest errors. A study is a link to the page in its own folder, relative to where this page lies.
std::string batch_page(const std::vector<BatchRow>& rows);

}  // namespace pastefit
