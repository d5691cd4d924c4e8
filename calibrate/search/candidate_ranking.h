#pragma once

#include <span>
#include <vector>

#include "calibrate/search/evaluation_history.h"
#include "calibrate/search/surrogate.h"

namespace pastefit {

/// An expected margin that is worth a simulation, in tolerances.
inline constexpr double worthwhile_margin = 0.02;

/// The candidates of a search in the light of all that was simulated so far. The one that reads best is often the
/// luckiest; what its neighbours read, with luck of their own, tells them apart.
/// Requirement: some evidence is feasible.
class CandidateRanking {
 public:
  /// `refuted`: candidates that a confirmation has judged, which are none any more.
  CandidateRanking(const EvaluationHistory& history, std::span<const UnitPoint> refuted);

  const Surrogate& surrogate() const { return surrogate_; }
  /// Of those simulated to their end the one of the largest expected margin, or, where none has any to speak of, of the
  /// least expected misfit; no point if there is none.
  const UnitPoint& best() const { return best_; }
  /// What it is expected to have; infinite if there is none.
  double misfit_of_best() const { return misfit_of_best_; }
  double margin_of_best() const { return margin_of_best_; }  ///< 0, where it is none to speak of
  /// The least that is expected anywhere where something was simulated.
  const UnitPoint& least() const { return least_; }
  double least_misfit() const { return least_misfit_; }

  /// Probability that every fitted reading of a candidate is within so many tolerances, noise of the packings apart,
  /// that a confirmation would hold by the heaps that a laboratory rejects,
  /// and every parameter of which something is known beforehand within two standard deviations of it.
  double chance_of(const UnitPoint& point, double tolerances) const {
    return chances_of(surrogate_, point, {&tolerances, 1}).front();
  }
  /// The same whatever the heaps that a laboratory rejects.
  double chance_of_readings(const UnitPoint& point, double tolerances) const;

  /// Expected margin of a candidate: the mean of max(0, 1 - w), where its worst fitted reading is off by w tolerances;
  /// nothing where the heaps or what is known beforehand speak against it (`chance_of`). The misfit prefers a candidate
  /// that makes up for a reading that is missed by others that are met; the margin does not. `model`: instead of the
  /// ranking's own, e.g. with answers that are expected.
  double expected_margin(const UnitPoint& point) const { return expected_margin(surrogate_, point); }
  double expected_margin(const Surrogate& model, const UnitPoint& point) const;

 private:
  std::vector<double> chances_of(const Surrogate& model, const UnitPoint& point,
                                 std::span<const double> tolerances) const;
  std::vector<double> chances_of_readings(const Surrogate& model, const UnitPoint& point,
                                          std::span<const double> tolerances) const;

  const EvaluationHistory& history_;
  Surrogate surrogate_;
  UnitPoint best_, least_;
  double misfit_of_best_, least_misfit_, margin_of_best_ = 0;
};

}  // namespace pastefit
