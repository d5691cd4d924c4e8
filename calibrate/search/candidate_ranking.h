#pragma once

#include <span>
#include <vector>

#include "calibrate/search/evaluation_history.h"
#include "calibrate/search/surrogate.h"

namespace pastefit {

/// Smallest expected margin that justifies a simulation [tolerances].
inline constexpr double worthwhile_margin = 0.02;

/// Ranks candidates by their posterior given all simulations. The best observed candidate is biased by replicate
/// scatter (winner's curse); the posterior also uses its neighbours. Requirement: at least one feasible simulation.
class CandidateRanking {
 public:
  /// `refuted`: candidates to exclude because a confirmation rejected them.
  CandidateRanking(const EvaluationHistory& history, std::span<const UnitPoint> refuted);

  const Surrogate& surrogate() const { return surrogate_; }
  /// Completely simulated candidate of largest expected margin; if all margins are below `worthwhile_margin`, the one
  /// of least expected misfit. No point if there is none.
  const UnitPoint& best() const { return best_; }
  /// Completely simulated candidate of least expected misfit. No point if there is none.
  const UnitPoint& most_plausible() const { return most_plausible_; }
  /// Expected misfit of the best; infinite if there is none.
  double misfit_of_best() const { return misfit_of_best_; }
  double margin_of_best() const { return margin_of_best_; }  ///< 0 if below `worthwhile_margin`
  /// Simulated point of least expected misfit, stopped runs and coarse grains included.
  const UnitPoint& least() const { return least_; }
  double least_misfit() const { return least_misfit_; }

  /// Probability that every fitted mean reading is within this many tolerances and every parameter with a prior within
  /// two standard deviations of it, times the probability that so few heaps are rejected that a confirmation would
  /// succeed.
  double chance_of(const UnitPoint& point, double tolerances) const {
    return chances_of(surrogate_, point, {&tolerances, 1}).front();
  }
  /// The same without the factor for rejected heaps.
  double chance_of_readings(const UnitPoint& point, double tolerances) const {
    return chances_of_readings(surrogate_, point, {&tolerances, 1}).front();
  }

  /// Expected margin: mean of max(0, 1 - w), w the error of the worst fitted reading in tolerances, with the factors
  /// for heaps and priors of `chance_of`. In a misfit an exact reading can compensate for one that misses, in this
  /// margin it cannot. `model`: replaces the ranking's surrogate, e.g. by one with fantasised answers.
  double expected_margin(const UnitPoint& point) const { return expected_margin(surrogate_, point); }
  double expected_margin(const Surrogate& model, const UnitPoint& point) const;

 private:
  std::vector<double> chances_of(const Surrogate& model, const UnitPoint& point,
                                 std::span<const double> tolerances) const;
  std::vector<double> chances_of_readings(const Surrogate& model, const UnitPoint& point,
                                          std::span<const double> tolerances) const;

  const EvaluationHistory& history_;
  Surrogate surrogate_;
  UnitPoint best_, most_plausible_, least_;
  double misfit_of_best_, least_misfit_, margin_of_best_ = 0;
};

}  // namespace pastefit
