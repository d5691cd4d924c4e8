#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "calibrate/study/unstated_conditions.h"

namespace pastefit {

/// One reading, measured and simulated.
struct ReadingTrainingData {
  std::string name;
  std::size_t test = 0;            ///< index in the study
  std::optional<double> measured;  ///< mean of the repeats; empty: not measured
  double deviation = 0;            ///< standard deviation of one measurement, in the reading's unit
  int repeats = 1;
  double widening = 1;         ///< factor on the deviation if estimated from the repeats (`base/statistics.h`)
  double weight = 0;           ///< in the fit; 0: not fitted
  Eigen::VectorXd simulated;   ///< of each simulation; NaN: it ended before this reading, or is rejected
  std::vector<bool> is_bound;  ///< true: stopped early, the value is an upper bound; empty: none

  bool fitted() const { return measured && weight > 0; }
  /// Variance of the measured mean: (widening deviation)^2/(repeats weight).
  double variance() const { return widening * widening * deviation * deviation / (repeats * weight); }
  bool bound(std::size_t simulation) const { return !is_bound.empty() && is_bound[simulation]; }
};

/// Training data of a study from finished simulations.
struct TrainingData {
  std::vector<Parameter> parameters;  ///< free ones: the coordinates of the points
  std::vector<UnitPoint> points;      ///< of the feasible simulations, one for each simulated value
  std::vector<UnitPoint> failed;      ///< of the failed ones
  std::vector<ReadingTrainingData> readings;
  /// Rejection index of each simulation: beyond 1 a laboratory rejects the heap, e.g. because it sheared off. NaN:
  /// unknown; empty: not judged.
  std::vector<double> rejection_indices;
  int accepted_heaps = 0;                   ///< heaps reported by the laboratory, hence not rejected
  std::vector<ConditionEffect> conditions;  ///< effects of conditions that the laboratory file does not state
};

/// Collects training data from stored evaluations. The reading that stopped a simulation is an upper bound if it ended
/// below the measurement; readings that it lacks are left out. Rejected heaps do not count for the readings, unless all
/// are rejected.
TrainingData training_data_of(const Study& study, std::span<const StoredEvaluation> evaluations);

}  // namespace pastefit
