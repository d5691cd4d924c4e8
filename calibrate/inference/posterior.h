#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

/// Samples the unit cube with a density proportional to the likelihood, for a prior uniform within the bounds.
/// Requirements: dimension >= 1, count >= 2. Method: sequential Monte Carlo (Del Moral, Doucet & Jasra, J. R. Stat.
/// Soc. B 68 (2006) 411): a Sobol sample is weighted by a growing power of the likelihood, resampled when its effective
/// size is halved, and moved by random walks as wide as the sample. It finds separate modes and curved ridges, where a
/// linear approximation fails. A log-likelihood that is not finite counts as zero likelihood. The same arguments give
/// the same sample.
std::vector<UnitPoint> posterior_sample(const std::function<double(const UnitPoint&)>& log_likelihood, int dimension,
                                        int count, std::uint64_t seed);

struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};
Moments moments_of(const std::vector<UnitPoint>& sample);

inline constexpr int further_measurements = 5;

/// Predicted effect of further measurements of one reading on the posterior.
struct MeasurementGain {
  std::string reading;
  int measurements = further_measurements;
  double deviation = 0;   ///< standard deviation of one, in the reading's unit
  std::string parameter;  ///< parameter whose standard deviation decreases most
  double narrowing = 1;   ///< its standard deviation afterwards over that before
};

/// Gains of further measurements of each reading that a laboratory can take and that the model meets, best
/// first.
std::vector<MeasurementGain> measurement_gains(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                               const Moments& moments, const UnitPoint& recommended);

}  // namespace pastefit
