#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/inference/parameter_interval.h"
#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"
#include "calibrate/inference/training_data.h"

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

/// The half of the points with the smaller distances.
std::vector<UnitPoint> better_half(const ResponseModel& model, const std::vector<UnitPoint>& points);

/// Those points of which every fitted reading is expected within the laboratory's deviation, or as near as the
/// recommended one's. None is named where the response jumps and nobody has simulated it.
std::vector<UnitPoint> fitting(const ResponseModel& model, const std::vector<UnitPoint>& points,
                               const UnitPoint& recommended);

/// The recommended candidate, then simulated ones that fit, then predicted ones; all within the intervals.
std::vector<EquivalentMaterial> family_of(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                          const UnitPoint& recommended, const std::vector<ParameterInterval>& intervals,
                                          int count);

/// What the simulations and the laboratory say about the free parameters.
struct Inference {
  std::vector<std::string> fitted;               ///< the readings behind it
  std::vector<double> noise;                     ///< standard deviation of each between packings of the
                                                 ///< recommended candidate
  std::vector<ParameterInterval> intervals;      ///< of the free parameters, in their order
  std::vector<std::vector<double>> correlation;  ///< of the free parameters in the posterior
  std::vector<Combination> combinations;         ///< best determined first; one for each free parameter
  bool linear = false;                           ///< the combinations explain the intervals; if not, the
                                                 ///< intervals hold
  bool jumps = false;                            ///< near the recommended candidate, so that nothing is predicted there
  std::vector<EquivalentMaterial> family;        ///< far apart from each other; the recommended one first
  std::vector<MeasurementGain> gains;            ///< best first
  std::vector<ConditionEffect> conditions;       ///< effects of unstated conditions; contained in the intervals
  std::string recommended_because;               ///< why the first of the family is recommended
  int simulations = 0;                           ///< number of simulations used
};

struct InferenceOptions {
  int sample = 3000;  ///< size of the posterior sample
  int family = 5;     ///< equivalent materials shown, the recommended one included
  int repeats = 5;    ///< further measurements whose gain is predicted
  std::uint64_t seed = 1;
};

/// Candidates to simulate next: from the posterior sample, as far from each other and from `recommended` as possible;
/// first the ends of the range of a single parameter, where they may meet the laboratory. Shape: `count` points, fewer
/// if the sample has no more.
std::vector<UnitPoint> candidates_to_examine(const TrainingData& evidence, const UnitPoint& recommended, int count,
                                             const InferenceOptions& options = {});

/// Infers the free parameters of a study without further simulations: likelihood of `response_model.h`, sample of
/// `posterior.h`. The prior is uniform between the bounds, on the parameter's scale, times the prior that the study
/// gives. Limits: contact law and grain size count as right; their error is in none of the intervals. Requirements: at
/// least one simulation ended well, `recommended` lies in the unit cube, at least one reading is fitted.
Inference infer(const TrainingData& evidence, const UnitPoint& recommended, const InferenceOptions& options = {});

}  // namespace pastefit
