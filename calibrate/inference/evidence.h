#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/search/gaussian_process.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// One reading as the laboratory took it, and as the simulations answered it.
struct ReadingEvidence {
  std::string name;
  std::optional<double> measured;  ///< mean of the laboratory's repeats; empty: not measured
  double deviation = 0;            ///< standard deviation of one measurement, in the reading's unit
  int repeats = 1;
  double widening = 1;        ///< of the deviation, where it was estimated from the repeats (`base/statistics.h`)
  double weight = 0;          ///< in the fit; 0: not fitted
  Eigen::VectorXd simulated;  ///< NaN: the simulation ended before it

  bool fitted() const { return measured && weight > 0; }
  /// Variance of the laboratory's mean: (widening deviation)^2/(repeats weight).
  double variance() const { return widening * widening * deviation * deviation / (repeats * weight); }
};

/// All that finished simulations say about a study.
struct Evidence {
  std::vector<Parameter> parameters;  ///< the free ones: the coordinates of the points
  std::vector<UnitPoint> points;      ///< of the simulations that ended well; one
                                      ///< for each simulated value
  std::vector<UnitPoint> failed;      ///< of those that did not
  std::vector<ReadingEvidence> readings;
};

/// Collects the evidence from a record (`search/record.h`). A reading that some simulations lack, because they ended
/// early, is learnt from the others.
Evidence evidence_of(const Study& study, std::span<const StoredEvaluation> evaluations);

/// What a simulation of any candidate is likely to read, learnt from the
/// evidence: a Gaussian process for each reading and for the share of failures.
/// The likelihood of a candidate follows: the laboratory's mean is off the mean
/// answer of the simulations by the laboratory's own error and by what is not
/// known of that answer. Requirement: at least one simulation ended well.
class ResponseModel {
 public:
  explicit ResponseModel(Evidence evidence);

  const Evidence& evidence() const { return evidence_; }
  /// Mean reading of a candidate, and the variance of what is known of it.
  GaussianProcess::Prediction predict(std::size_t reading, const UnitPoint& point) const;
  /// Standard deviation of the reading of one simulation about its mean.
  double noise(std::size_t reading) const;
  /// Distance of the mean readings from the laboratory, and of the point from what was known beforehand: root of the
  /// sum of squares, each in standard deviations, of one measurement or of the prior.
  double miss(const UnitPoint& point) const;
  double log_likelihood(const UnitPoint& point) const;
  /// The same, and what was known beforehand.
  double log_posterior(const UnitPoint& point) const;

 private:
  Evidence evidence_;
  std::vector<GaussianProcess> models_;
  std::optional<GaussianProcess> failures_;
};

}  // namespace pastefit
