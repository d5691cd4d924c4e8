#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/evaluate/objective.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "calibrate/study/unstated_conditions.h"

namespace pastefit {

/// One reading, measured and simulated.
struct ReadingTrainingData {
  std::string name;
  std::size_t test = 0;            ///< of the study
  std::optional<double> measured;  ///< mean of the laboratory's repeats; empty: not measured
  double deviation = 0;            ///< standard deviation of one measurement, in the reading's unit
  int repeats = 1;
  double widening = 1;         ///< factor on the deviation if it was estimated from the repeats (`base/statistics.h`)
  double weight = 0;           ///< in the fit; 0: not fitted
  Eigen::VectorXd simulated;   ///< of each simulation; NaN: it ended before this reading, or would be rejected
  std::vector<bool> is_bound;  ///< the simulation was stopped early, its value is an upper bound; empty: none was

  bool fitted() const { return measured && weight > 0; }
  /// Variance of the laboratory's mean: (widening deviation)^2/(repeats weight).
  double variance() const { return widening * widening * deviation * deviation / (repeats * weight); }
  bool bound(std::size_t simulation) const { return !is_bound.empty() && is_bound[simulation]; }
};

/// All that finished simulations say about a study.
struct TrainingData {
  std::vector<Parameter> parameters;  ///< the free ones: the coordinates of the points
  std::vector<UnitPoint> points;      ///< of the simulations that ended well, one for each simulated value
  std::vector<UnitPoint> failed;      ///< of those that failed
  std::vector<ReadingTrainingData> readings;
  /// Rejection index of each simulation: beyond 1 a laboratory would reject it, e.g. because the heap sheared off.
  /// NaN: not read; empty: not judged.
  std::vector<double> rejection_indices;
  int accepted_heaps = 0;                   ///< heaps that the laboratory reports, and so did not reject
  std::vector<ConditionEffect> conditions;  ///< those that the laboratory does not state
};

/// Collects the evidence from stored evaluations. Of a simulation that was stopped early the reading that stopped it is
/// an upper bound if it ended below the laboratory's; readings that it lacks are left out. Only simulations that a
/// laboratory would not reject count for the readings; all of them, if it would reject every one.
TrainingData training_data_of(const Study& study, std::span<const StoredEvaluation> evaluations);

}  // namespace pastefit
