#pragma once

#include <vector>

#include "calibrate/inference/parameter_interval.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

/// A candidate that meets the laboratory as well as the recommended one, as far as is known.
struct EquivalentMaterial {
  UnitPoint point;
  std::vector<double> values;    ///< of the free parameters
  std::vector<double> readings;  ///< predicted, in the order of `Inference::fitted`
  bool simulated = false;        ///< else only predicted
  double distance = 0;           ///< `ResponseModel::distance`
};

/// Adds points that are as far from each other, and from those chosen already, as possible; stops at `count` in all, or
/// when all that are left lie nearer than `apart` to a chosen one.
void spread_out(std::vector<UnitPoint>& chosen, const std::vector<UnitPoint>& points, std::size_t count,
                double apart = 0);

/// The half of the points with the smaller normalised errors.
std::vector<UnitPoint> better_half(const ResponseModel& model, const std::vector<UnitPoint>& points);

/// Those points of which every fitted reading is expected within the laboratory's deviation, or as near as the
/// recommended one's. None is named where the response jumps and nobody has simulated it.
std::vector<UnitPoint> fitting(const ResponseModel& model, const std::vector<UnitPoint>& points,
                               const UnitPoint& recommended);

/// The recommended candidate, then simulated ones that fit, then predicted ones; all within the intervals.
std::vector<EquivalentMaterial> family_of(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                          const UnitPoint& recommended, const std::vector<ParameterInterval>& intervals,
                                          int count);

}  // namespace pastefit
