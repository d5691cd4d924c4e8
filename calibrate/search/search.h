#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "calibrate/search/calibration.h"
#include "calibrate/search/strategies.h"

namespace pastefit {

/// Calibration with an ask-and-tell interface; the simulations may run anywhere:
///
///     Search search(scoring, options, start);
///     while (!search.finished()) {
///       for (const Candidate& candidate : search.suggest(n)) ...        // simulate, on any machine
///       search.ingest(results);                                         // in any order
///     }
///     search.result();
///
/// Requirements: `validate(options, scoring.parameters(), scoring.simulations_each())` is empty; `scoring` outlives the
/// search; one caller at a time. The suggestions depend on the answers in the order of asking and on
/// `SearchOptions::max_pending`, not on which answer arrives first: the card is the same for any number of workers. The
/// state of a search is its answers: one that gets the same answers takes the same path. `strategy.h` describes the
/// phases. No call blocks, and no thread is started; `suggest`, `ingest` and `stop` advance the search and call
/// `progress`. Errors: std::logic_error if a requirement is broken or an answer was not suggested.
class Search {
 public:
  Search(const Scoring& scoring, const SearchOptions& options, SearchStart start,
         std::function<void(const Progress&)> progress = {});
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;
  ~Search();

  /// At most `count` new candidates; none if the search needs further answers first, or has finished.
  std::vector<Candidate> suggest(std::size_t count);
  /// Known answers are ignored.
  void ingest(std::span<const CandidateResult> results);
  /// Ends the search; open candidates count as cut off.
  void stop();
  bool finished() const;
  /// Requirement: it has finished.
  const Calibration& result() const;

 private:
  struct Run;
  std::unique_ptr<Run> run_;
};

}  // namespace pastefit
