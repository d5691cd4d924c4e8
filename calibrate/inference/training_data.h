#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/search/objective.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "calibrate/study/unstated_conditions.h"

namespace pastefit {

/// One reading as the laboratory took it, and as the simulations answered it.
struct ReadingTrainingData {
  std::string name;
  std::size_t test = 0;            ///< of the study
  std::optional<double> measured;  ///< mean of the laboratory's repeats; empty: not measured
  double deviation = 0;            ///< standard deviation of one measurement, in the reading's unit
  int repeats = 1;
  double widening = 1;         ///< of the deviation, where it was estimated from the repeats (`base/statistics.h`)
  double weight = 0;           ///< in the fit; 0: not fitted
  Eigen::VectorXd simulated;   ///< NaN: the simulation ended before it, or a laboratory would reject it
  std::vector<bool> is_bound;  ///< that simulation ended early, and would have read so or less; empty: none did

  bool fitted() const { return measured && weight > 0; }
  /// Variance of the laboratory's mean: (widening deviation)^2/(repeats weight).
  double variance() const { return widening * widening * deviation * deviation / (repeats * weight); }
  bool bound(std::size_t simulation) const { return !is_bound.empty() && is_bound[simulation]; }
};

/// All that finished simulations say about a study.
struct TrainingData {
  std::vector<Parameter> parameters;  ///< the free ones: the coordinates of the points
  std::vector<UnitPoint> points;      ///< of the simulations that ended well; one
                                      ///< for each simulated value
  std::vector<UnitPoint> failed;      ///< of those that did not
  std::vector<ReadingTrainingData> readings;
  /// How near each point is to one that a laboratory would reject, e.g. a heap that sheared off: it would beyond 1.
  /// NaN: it was not read; empty: not judged.
  std::vector<double> rejection_indices;
  int accepted_heaps = 0;  ///< of the laboratory: those that it reports, which it would not if it rejected them
  std::vector<ConditionEffect> conditions;  ///< of which the laboratory says nothing
};

/// Collects the evidence from a record (`search/record.h`). Of a simulation that ended early the reading that ended it
/// is a bound, where it ended below, and the readings that it lacks are learnt from the others. Readings are learnt
/// from the simulations that a laboratory would not reject; from all, if it would reject every one.
TrainingData training_data_of(const Study& study, std::span<const StoredEvaluation> evaluations);

}  // namespace pastefit
