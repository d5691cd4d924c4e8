#pragma once

#include <string>
#include <vector>

#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

/// A linear combination of the parameters that the readings determine, near the recommended candidate: a right singular
/// vector of the scaled Jacobian of the readings.
struct Combination {
  std::vector<double> direction;      ///< unit vector; its components are changes of the free parameters over their
                                      ///< prior standard deviations (`deviation_before`)
  double singular_value = 0;          ///< of the Jacobian, readings and parameters in their standard deviations
  double uncertainty = 1;             ///< posterior over prior standard deviation along it: 1/sqrt(1 +
                                      ///< singular_value^2), or that of the sample if larger
  std::size_t lead = 0;               ///< the parameter with the largest component, which is positive
  double lead_width = 0;              ///< 95 % half width as a change of the lead alone: relative if its scale is
                                      ///< logarithmic, else in its unit
  std::vector<std::string> readings;  ///< that depend on it, the strongest first

  bool determined() const { return uncertainty <= 0.5; }
};

/// From the slopes of the fitted readings at a candidate; best determined first, one for each free parameter.
std::vector<Combination> combinations_of(const ResponseModel& model, const std::vector<std::size_t>& fitted,
                                         const UnitPoint& at);

/// Widens a combination to the standard deviation of the sample along it: slopes at one point promise too much where
/// the posterior is curved. The sample's alone counts where the combination is the only one.
void heed_sample(Combination& combination, const TrainingData& evidence, const Moments& moments);

}  // namespace pastefit
