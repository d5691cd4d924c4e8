#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "calibrate/evaluate/objective.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

/// A sample of the unit cube with a density proportional to the likelihood, the prior being uniform within the bounds
/// of a study. Method: sequential Monte Carlo. A Sobol sample of the cube is weighted by a growing power of the
/// likelihood, resampled when half of its effective size is lost, and moved by random walks as wide as the sample (Del
/// Moral, Doucet & Jasra, J. R. Stat. Soc. B 68 (2006) 411). It finds separate modes and curved ridges, where a linear
/// approximation fails. Requirements: dimension >= 1, count >= 2; where the logarithm is not finite the likelihood
/// counts as zero. The same arguments give the same sample.
std::vector<UnitPoint> posterior_sample(const std::function<double(const UnitPoint&)>& log_likelihood, int dimension,
                                        int count, std::uint64_t seed);

/// Of a sample.
struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};
Moments moments_of(const std::vector<UnitPoint>& sample);

/// How much further measurements of one reading would narrow the posterior.
struct MeasurementGain {
  std::string reading;
  int measurements = 0;       ///< number of them
  double deviation = 0;       ///< of one of them, in the reading's unit
  std::string parameter;      ///< whose standard deviation shrinks most
  double narrowing = 1;       ///< its standard deviation afterwards over that before
  double lead_narrowing = 1;  ///< the same for the lead of the best determined combination
};

/// Gains of `repeats` further measurements, for each reading that a laboratory can take and that the model meets, best
/// first. `lead`: the parameter with the largest part in the best determined combination.
std::vector<MeasurementGain> measurement_gains(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                               const Moments& moments, const UnitPoint& recommended, std::size_t lead,
                                               int repeats);

}  // namespace pastefit
