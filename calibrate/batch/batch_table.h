#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/batch/batch.h"

namespace pastefit {

/// What is known of one study of a batch, for the table.
struct BatchRow {
  /// A number under the name of its column, which carries its unit.
  struct Number {
    std::string name;
    std::optional<double> value;
  };
  struct Reading {
    std::string name;
    double measured = 0, simulated = 0;
  };
  struct Fitted {
    std::string name;
    double value = 0;
    std::optional<double> lower, upper;  ///< ends of the 95 % interval, where it is known
    BoundEnds at_bounds = {};            ///< ends that are the study's bounds, and not set by the readings
  };
  std::string name, title;
  /// "confirmed", "unconfirmed", "out_of_reach", "stopped", "failed" as in a card; "unfinished": there is no card yet;
  /// "pending": nothing was simulated.
  std::string verdict;
  std::string reasons;                  ///< why it is not confirmed, and what speaks against a card, in words
  std::optional<double> error;          ///< largest error in tolerances
  std::optional<double> sheared_share;  ///< of the heaps that confirmed it
  std::uint64_t seed = 0;
  int simulations = 0, coarse_simulations = 0;
  double core_s = 0;  ///< of all simulations in the store
  std::string program;
  std::vector<Number> laboratory;  ///< bulk density and the mix, by their places in the laboratory file
  std::vector<Reading> readings;   ///< that the laboratory took
  std::vector<Fitted> parameters;
};

/// What the study's folder tells. A folder that is not there or damaged is a verdict, too.
BatchRow row_of(const BatchStudy& one);

/// How bad a verdict is: 0 is the worst.
int rank_of(const BatchRow& row);

/// The rows that a person has to look at come first: by verdict, then by the largest error.
std::vector<BatchRow> worst_first(std::vector<BatchRow> rows);

/// The table as comma-separated values, one row per study in the order given. A column that some study has and another
/// has not is empty there.
std::string batch_csv(const std::vector<BatchRow>& rows);

/// The names that occur in some list of the rows, each once, in the order in which they appear first.
template <class Entry>
std::vector<std::string> names_in(const std::vector<BatchRow>& rows, std::vector<Entry> BatchRow::*list) {
  std::vector<std::string> names;
  for (const BatchRow& row : rows)
    for (const Entry& entry : row.*list)
      if (std::ranges::find(names, entry.name) == names.end()) names.push_back(entry.name);
  return names;
}

/// The entry of this name; null if the list has none.
template <class Entry>
const Entry* find_named(const std::vector<Entry>& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &Entry::name);
  return found == list.end() ? nullptr : &*found;
}

/// The table as one page of HTML that asks nothing of a network and runs no script, the worst verdicts on top. A study
/// is a link to the page in its own folder, relative to where this page lies.
std::string batch_page(const std::vector<BatchRow>& rows);

}  // namespace pastefit
