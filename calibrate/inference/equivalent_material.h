#pragma once

#include <vector>

#include "calibrate/inference/response_model.h"

namespace pastefit {

/// A candidate that meets the laboratory as well as any other, as far as is
/// known.
struct EquivalentMaterial {
  UnitPoint point;
  std::vector<double> values;    ///< of the free parameters
  std::vector<double> readings;  ///< predicted, in the order of `Inference::fitted`
  bool simulated = false;        ///< else predicted from its neighbours
  double normalised_error = 0;   ///< root of the sum of squares, each in standard deviations of one measurement
};

/// Chooses points as far from each other, and from those chosen already, as can be; stops at `count` in all, or when
/// what is left lies nearer than `apart` to one that was chosen.
void spread_out(std::vector<UnitPoint>& chosen, const std::vector<UnitPoint>& points, std::size_t count,
                double apart = 0);

/// The half of the points that misses the laboratory least.
std::vector<UnitPoint> better_half(const ResponseModel& model, const std::vector<UnitPoint>& points);

/// The recommended candidate, then simulated ones of which every fitted reading is within the laboratory's deviation,
/// or as near as the recommended one's, then ones of which that is predicted.
std::vector<EquivalentMaterial> family_of(const ResponseModel& model, const std::vector<std::size_t>& fitted,
                                          const std::vector<UnitPoint>& sample, const UnitPoint& recommended,
                                          int count);

}  // namespace pastefit
