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

/// A calibration that suggests candidates and ingests what their simulations answered, wherever those run:
///
///     Search search(scoring, options, start);
///     while (!search.finished()) {
///       for (const Candidate& candidate : search.suggest(n)) ...        // simulate, on any machine
///       search.ingest(results);                                         // in any order
///     }
///     search.result();
///
/// What it suggests depends on the answers in the order of asking, up to `SearchOptions::max_pending` candidates under
/// way in the phase of proposals, never on who was ready first: the same card for any number of workers. Its state is
/// the answers it was told (`results`); a search that starts with them takes the same way without asking for them
/// again. The phases of the default strategy, and the others: `strategy.h`. No call waits, and there is no thread: the
/// search goes on within `suggest`, `ingest` and `stop`, from where `progress` is called. Requirements:
/// `validate(options, scoring.parameters(), scoring.simulations_each())` is empty; `scoring` outlives it. One caller at
/// a time. Errors: std::logic_error if a requirement is broken, or for an answer to what was not suggested.
class Search {
 public:
  Search(const Scoring& scoring, const SearchOptions& options, SearchStart start,
         std::function<void(const Progress&)> progress = {});
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;
  ~Search();

  /// At most so many candidates that were not suggested before; none, if there will be none before another answer is
  /// ingested, and at the end.
  std::vector<Candidate> suggest(std::size_t count);
  /// An answer that is known already is ignored.
  void ingest(std::span<const CandidateResult> results);
  /// The user or a limit wants to end: what is not answered yet counts as cut off.
  void stop();
  bool finished() const;
  /// Every answer so far, in the order of asking.
  std::vector<CandidateResult> results() const;
  /// Requirement: it has finished.
  const Calibration& result() const;

 private:
  struct Run;
  std::unique_ptr<Run> run_;
};

/// Runs a search on objectives that simulate on this machine, to its end or to a stop request of `objective`.
Calibration drive(Search& search, Objective& objective, Objective* coarse = nullptr);

/// The same in one call. `readings`, `parameters`: names for the reason; may be left empty. `coarse`: answers as
/// `objective` would with coarser grains, to packings from `coarse_packings` on; default strategy only.
/// Throws what the objective throws, and std::logic_error if the options are not valid.
Calibration search(Objective& objective, const SearchOptions& options,
                   const std::function<void(const Progress&)>& progress = {},
                   std::span<const std::string> readings = {}, std::span<const std::string> parameters = {},
                   Objective* coarse = nullptr);

}  // namespace pastefit
