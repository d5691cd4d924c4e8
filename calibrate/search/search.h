#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/search/confirmation_phase.h"
#include "calibrate/search/reachability.h"
#include "calibrate/search/strategy_state.h"

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
/// It finds a candidate within the tolerances and confirms it on packings that it has not used; `README.md` describes
/// the phases. They aim at less than the tolerances because of the winner's curse, and at every parameter within two
/// standard deviations of its prior. Results of coarse grains enter only the surrogate, corrected by the bias between
/// the grain sizes (`surrogate.h`); they are not in the budget or in `history`. The budget of a confirmation is
/// reserved throughout. Limit: a mean that is judged up to fifteen times is accepted more often than one that is judged
/// once. Where one packing scatters by two tolerances, a material that misses by 1.2 of them is confirmed with a
/// probability of 0.35 instead of 0.23 (by 0.5 tolerances: 0.12 instead of 0.11; tests/results/search.md).
///
/// Requirements: `validate(options, scoring.parameters(), scoring.simulations_each())` is empty; `scoring` outlives the
/// search; one caller at a time. The suggestions depend on the answers in the order of asking and on
/// `SearchOptions::max_pending`, not on which answer arrives first: the card is the same for any number of workers. The
/// state of a search is its answers: one that gets the same answers takes the same path. No call blocks, and no thread
/// is started; `suggest`, `ingest` and `stop` advance the search and call `progress`. Errors: std::logic_error if a
/// requirement is broken or an answer was not suggested; others in the status.
class Search {
 public:
  Search(const Scoring& scoring, const SearchOptions& options, SearchStart start,
         std::function<void(const Progress&)> progress = {});
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// At most `count` new candidates; none if the search needs further answers first, or has finished.
  std::vector<Candidate> suggest(std::size_t count);
  /// Known answers are ignored.
  void ingest(std::span<const CandidateResult> results);
  /// Ends the search; open candidates count as cut off.
  void stop();
  bool finished() const { return stage_ == Stage::over; }
  /// Requirement: it has finished.
  const Calibration& result() const;

 private:
  enum class Stage {
    coarse_screening,
    screening,
    bracket,
    bracket_confirmation,
    reach,
    nearest,  // to a reading out of reach, on all common packings
    nearest_confirmation,
    candidates,
    refinement,
    recommendation,
    confirmation,
    last_confirmation,
    over
  };

  /// Advances as far as the answers in the queue allow.
  void advance();
  void begin(Stage stage, std::unique_ptr<SearchPhase> phase);
  void begin_confirmation(Stage stage, bool whatever_it_does, const UnitPoint& asked = {});
  void begin_reach();
  void begin_nearest();
  /// Starts the next round of candidates; ends the search if it may not go on.
  void begin_candidates();
  void begin_end();
  /// Starts the next stage.
  void go_on();
  void go_on_after_nearest();
  /// Tests again, with all simulations, whether a reading is out of reach; withdraws the claim if not.
  bool claim_stands();
  void conclude();
  /// Sets status and reason of the result (`conclusion.cpp`); its other fields are set. `out_of_reach`: as known now.
  void explain(const std::optional<OutOfReach>& out_of_reach);

  const SearchOptions options_;
  const SearchStart start_;
  const std::function<void(const Progress&)> progress_;
  CandidateQueue queue_;
  const bool by_surrogate_, with_coarse_;
  StrategyState state_;  // refers to the members above
  ConfirmationPhase confirmation_;
  std::unique_ptr<SearchPhase> phase_;  // of the stage, except confirmations
  SearchPhase* advanced_ = nullptr;     // `phase_` or `confirmation_`; null: nothing to advance
  std::optional<OutOfReach> out_of_reach_;
  bool searched_ = false;  // `begin_candidates` was called
  Stage stage_ = Stage::coarse_screening;
  Calibration result_;
};

}  // namespace pastefit
