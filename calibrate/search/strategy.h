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

/// Finds a candidate within the tolerances and confirms it on packings that the search has not used.
///   1. Screening: space-filling points on one packing, all at once; earlier results count as screening. If a reading
///      is out of reach (`reachability.h`), the nearest candidate is confirmed and the search ends, unless simulations
///      of this candidate refute the claim. With `coarse`, the screening and every candidate of the default strategy
///      run with coarse grains first. Coarse results enter only the surrogate, corrected by the bias between the grain
///      sizes (`low_fidelity.h`); they are not in the budget or in `history`.
///   2. Search. "default": a Gaussian process of each residual, trained on all simulations. The point of largest
///      acquisition (`proposals.h`) is simulated on a fresh packing and may end early (`evaluate/simulation.h`, as in
///      the screening); a simulation that ended early is completed if its bound does not rule the point out. This
///      repeats until a candidate is more likely than not to be confirmed (`candidate_ranking.h`), or the acquisition
///      is negligible. Up to `max_pending` candidates are pending at the next proposal. An NLopt algorithm by name, or
///      Ceres ("levenberg_marquardt", "dogleg"): runs on the simulations from the best screening point, on all common
///      packings, with half of the remaining budget.
///   3. Refinement: Ceres on the residuals on the common packings, if no candidate's readings are likely to be
///      confirmed and the noise of these packings is below the allowed misfit.
///   4. Recommendation, by the default strategy: of the candidates that are likely to be confirmed, the one of least
///      expected misfit, priors included (`recommendation.h`).
///   5. Confirmation of this candidate on fresh packings: a quarter first, and no more if success is then unlikely;
///      all at once with `max_pending`; up to eight times the study's number while undecided (`confirmation_phase.h`).
///      A candidate that is not confirmed is excluded, and the search continues from 2 with all results. Limit: a mean
///      that is judged up to fifteen times is accepted more often than one that is judged once. A material that misses
///      by 1.2 tolerances is confirmed with probability 0.35 instead of 0.23 if packings scatter by 2 tolerances, and
///      with 0.12 instead of 0.11 if they scatter by 0.5 tolerances (tests/results/search.md).
/// The goal of 2 and 3 is stricter than the tolerance because of the winner's curse; it also requires every parameter
/// within two standard deviations of its prior. The budget of a confirmation is reserved throughout. Requirements:
/// `validate(options, scoring.parameters(), scoring.simulations_each())` is empty; the arguments of the constructor
/// outlive the strategy. The path depends on the answers only. Errors: in the status.
class Strategy {
 public:
  Strategy(CandidateQueue& queue, const SearchOptions& options, const SearchStart& start,
           const std::function<void(const Progress&)>& progress);

  /// Advances as far as the answers in the queue allow.
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
    nearest,  // to a reading out of reach, on all common packings
    nearest_confirmation,
    candidates,
    refinement,
    recommendation,
    confirmation,
    last_confirmation,
    over
  };

  void begin(Stage stage, std::unique_ptr<SearchPhase> phase);
  void begin_confirmation(Stage stage, bool whatever_it_does, const UnitPoint& asked = {});
  void begin_bracket();
  void begin_reach();
  void begin_nearest();
  /// Starts the next round of candidates; ends the search if it may not go on.
  void begin_candidates();
  void begin_recommendation();
  void begin_end();
  /// Starts the next stage.
  void go_on();
  void go_on_after_nearest();
  bool any_evidence() const;
  /// Tests again, with all simulations, whether a reading is out of reach; withdraws the claim if not.
  bool claim_stands();
  /// Range of each reading, corrected coarse simulations included.
  std::vector<Reach> reach() const;
  void conclude();
  /// Sets status and reason of the result (`conclusion.cpp`); its other fields are set. `out_of_reach`: as known now.
  void explain(const std::optional<OutOfReach>& out_of_reach);

  const bool with_coarse_;
  StrategyState state_;
  ConfirmationPhase confirmation_;
  std::unique_ptr<SearchPhase> phase_;  // of the stage, except confirmations
  SearchPhase* advanced_ = nullptr;     // `phase_` or `confirmation_`; null: nothing to advance
  std::span<const std::string> readings_, parameters_;
  std::optional<OutOfReach> out_of_reach_;
  bool searched_ = false;  // `begin_candidates` was called
  Stage stage_ = Stage::coarse_screening;
  Calibration result_;
};

}  // namespace pastefit
