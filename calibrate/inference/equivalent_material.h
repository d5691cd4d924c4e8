#pragma once

#include <vector>

#include "calibrate/inference/response_model.h"

namespace pastefit {

/// A candidate that meets the laboratory as well as the recommended one, as far as is known.
struct EquivalentMaterial {
  UnitPoint point;
  std::vector<double> values;    ///< of the free parameters
  std::vector<double> readings;  ///< predicted, in the order of `Inference::fitted`
  bool simulated = false;        ///< else only predicted
  double normalised_error = 0;   ///< `ResponseModel::normalised_error`
};

/// Adds points that are as far from each other, and from those chosen already, as possible; stops at `count` in all, or
/// when all that are left lie nearer than `apart` to a chosen one.
void spread_out(std::vector<UnitPoint>& chosen, const std::vector<UnitPoint>& points, std::size_t count,
                double apart = 0);

/// The half of the points with the smaller normalised errors.
std::vector<UnitPoint> better_half(const ResponseModel& model, const std::vector<UnitPoint>& points);

/// The recommended candidate; then simulated ones whose fitted readings are each predicted within the laboratory's
/// standard deviation, or as near as the recommended one's; then such members of the sample.
std::vector<EquivalentMaterial> family_of(const ResponseModel& model, const std::vector<std::size_t>& fitted,
                                          const std::vector<UnitPoint>& sample, const UnitPoint& recommended,
                                          int count);

}  // namespace pastefit
