#pragma once

#include <string>
#include <vector>

#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

/// A combination of the parameters, as the readings see it near the recommended
/// candidate.
struct Combination {
  std::vector<double> direction;      ///< over the free parameters in units of what is open of each beforehand
                                      ///< (`deviation_before`), of length 1
  double singular_value = 0;          ///< of the Jacobian in standard deviations, readings over parameters
  double uncertainty = 1;             ///< as above: 1/sqrt(1 + singular_value^2), or that of the sample if larger
  std::size_t lead = 0;               ///< the parameter with the largest part; its part is positive
  double lead_width = 0;              ///< 95 % half width, as a change of the lead alone: a
                                      ///< share of it if logarithmic, else in its unit
  std::vector<std::string> readings;  ///< that see it, the most important one first

  bool determined() const { return uncertainty <= 0.5; }
};

/// By the slopes of the fitted readings at a candidate, best determined first; one for each free parameter.
std::vector<Combination> combinations_of(const ResponseModel& model, const std::vector<std::size_t>& fitted,
                                         const UnitPoint& at);

/// Slopes at one point promise too much where the valley bends; the sample's own width along the combination counts.
void heed_sample(Combination& combination, const TrainingData& evidence, const Moments& moments);

}  // namespace pastefit
