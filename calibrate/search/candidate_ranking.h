#pragma once

#include <span>

#include "calibrate/search/evaluation_history.h"
#include "calibrate/search/surrogate.h"

namespace pastefit {

/// The candidates of a search in the light of all that was simulated so far. The one that reads best is often the
/// luckiest; what its neighbours read, with luck of their own, tells them apart.
/// Requirement: some evidence is feasible.
class CandidateRanking {
 public:
  /// `refuted`: candidates that a confirmation has judged, which are none any more.
  CandidateRanking(const EvaluationHistory& history, std::span<const UnitPoint> refuted);

  const Surrogate& surrogate() const { return surrogate_; }
  /// The one of least expected misfit, of those simulated to their end; no point if there is none.
  const UnitPoint& best() const { return best_; }
  /// What it is expected to have; infinite if there is none.
  double misfit_of_best() const { return misfit_of_best_; }
  /// The least that is expected anywhere where something was simulated.
  const UnitPoint& least() const { return least_; }
  double least_misfit() const { return least_misfit_; }

  /// Probability that every fitted reading of a candidate is within so many tolerances, noise of the packings apart,
  /// that a confirmation would hold by the heaps that a laboratory rejects,
  /// and every parameter of which something is known beforehand within two standard deviations of it.
  double chance_of(const UnitPoint& point, double tolerances) const;

 private:
  const EvaluationHistory& history_;
  Surrogate surrogate_;
  UnitPoint best_, least_;
  double misfit_of_best_, least_misfit_;
};

}  // namespace pastefit
