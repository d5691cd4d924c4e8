#pragma once

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

/// Calibrates: finds the candidate that meets the laboratory, and confirms it on packings the search has not used.
///   1. Screening: space-filling points on one packing, all at once. If they leave the laboratory out of reach for
///      certain (`reachability.h`), the nearest candidate is confirmed, and that is the end; unless it comes so near
///      that the claim is withdrawn. What is known from earlier counts as screening. With `coarse` on that instead, and
///      then every candidate of the default strategy is tried there first. What the coarse simulations say is corrected
///      by the bias between the rungs (`low_fidelity.h`) and counts in the surrogate as a simulation; nothing else
///      does. They are outside of the budget, and `history` does not hold them.
///   2. Search. "default": a Gaussian process for each residual learns from all simulations so far; the point that
///      promises most (`proposals.h`) is tried out on a fresh packing (`Objective::try_out`, as the screening), and
///      simulated to its end if the bound that this brings does not rule it out; until some candidate is more likely
///      than not to do (`candidate_ranking.h`), or nothing promises enough.
///      Up to `max_pending` candidates are under way when the next one is proposed. An NLopt algorithm by name: that
///      algorithm on the simulations themselves, from the best screening point, on all common packings, with half of
///      what is left of the budget; "levenberg_marquardt" and "dogleg": Ceres likewise.
///   3. Refinement: Ceres on the residuals on the common packings, if no candidate's readings are likely to do and the
///      noise of these packings is less than what is allowed.
///   4. Confirmation of the likely best candidate on fresh packings: a quarter of them first, and no more if it is
///      unlikely then that it will do, or with `max_pending` all at once; up to eight times as many as the options say
///      while their noise hides whether it meets the laboratory (`confirmation.h`). If it does not for certain, the
///      candidate is out and the search goes on from 2 with what all of them taught. Limit: a mean that is looked at up
///      to fifteen times is kinder than one that is looked at once: where one packing scatters by two tolerances a
///      material that misses by 1.2 of them is confirmed with a probability of 0.35 for 0.23 (by 0.5 tolerances: 0.12
///      for 0.11; tests/results/search.md).
/// The goal of 2 and 3 is stricter than the tolerance, because a candidate is picked for its luck with its
/// packings too; and it asks for a candidate within two standard deviations of what is known beforehand. The budget for
/// a confirmation is kept back all along. Requirements: `validate(options, scoring.parameters(),
/// scoring.simulations_each())` is empty; what the constructor is given outlives the strategy. The way depends on the
/// answers only: the same answers, the same calibration. Errors: in the status.
class Strategy {
 public:
  Strategy(CandidateQueue& queue, const SearchOptions& options, const SearchStart& start,
           const std::function<void(const Progress&)>& progress);

  /// Goes on as far as the answers in the queue reach.
  void advance();
  bool finished() const { return stage_ == Stage::over; }
  /// Requirement: it has finished.
  const Calibration& result() const { return result_; }

 private:
  enum class Stage {
    coarse_screening,
    screening,
    bracket,
    bracket_confirmation,
    reach,
    nearest,  // candidate to what is out of reach, on all common packings
    nearest_confirmation,
    candidates,
    refinement,
    confirmation,
    last_confirmation,
    over
  };

  void begin(Stage stage, std::unique_ptr<SearchPhase> phase);
  void begin_confirmation(Stage stage, bool whatever_it_does, const UnitPoint& asked = {});
  void begin_bracket();
  void begin_reach();
  void begin_nearest();
  /// The next round of candidates, if there can be one; the search before the first.
  void begin_candidates();
  void begin_end();
  /// What comes after a stage that is over.
  void go_on();
  void go_on_after_nearest();
  bool any_evidence() const;
  /// Asks again what was said to be out of reach, by all that was simulated since; withdraws it if it is not.
  bool claim_stands();
  /// What the model did with each reading, coarse simulations corrected.
  std::vector<Reach> reach() const;
  void conclude();

  const bool with_coarse_;
  StrategyState state_;
  ConfirmationPhase confirmation_;
  std::unique_ptr<SearchPhase> phase_;  // of the stage, but for confirmations
  SearchPhase* advanced_ = nullptr;     // either of them; none: nothing is to be done
  std::span<const std::string> readings_, parameters_;
  std::optional<OutOfReach> out_of_reach_;
  bool searched_ = false;  // a search was begun
  Stage stage_ = Stage::coarse_screening;
  Calibration result_;
};

}  // namespace pastefit
