#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/inference/parameter_interval.h"
#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"
#include "calibrate/inference/training_data.h"

namespace pastefit {

/// Candidate expected to fit as well as the recommended one.
struct EquivalentMaterial {
  UnitPoint point;
  std::vector<double> values;    ///< of the free parameters
  std::vector<double> readings;  ///< predicted, in the order of `Inference::fitted`
  bool simulated = false;        ///< else predicted
  double distance = 0;           ///< `ResponseModel::distance`
};

/// Inference of the free parameters from simulations and measurements.
struct Inference {
  std::vector<std::string> fitted;  ///< fitted readings
  std::vector<double> noise;        ///< standard deviation of each between packings of the recommended candidate
  std::vector<ParameterInterval> intervals;      ///< of the free parameters, in their order
  std::vector<std::vector<double>> correlation;  ///< of the free parameters in the posterior
  std::vector<Combination> combinations;         ///< best determined first; one for each free parameter
  bool jumps = false;                            ///< the response jumps at the recommended candidate: no predictions
  std::vector<EquivalentMaterial> family;        ///< far apart from each other; the recommended one first
  std::vector<MeasurementGain> gains;            ///< best first
  std::vector<ConditionEffect> conditions;       ///< effects of unstated conditions; included in the intervals
  std::string recommended_because;               ///< reason for recommending the first of the family
  int simulations = 0;                           ///< number of simulations used
};

struct InferenceOptions {
  int sample = 3000;  ///< size of the posterior sample
  std::uint64_t seed = 1;
};

/// Candidates to simulate next: members of the posterior sample, as far as possible from each other and from
/// `recommended`. For a single parameter, ends of the range that may fit come first. Shape: `count` points, fewer if
/// the sample has no more.
std::vector<UnitPoint> candidates_to_examine(const TrainingData& evidence, const UnitPoint& recommended, int count,
                                             const InferenceOptions& options = {});

/// Infers the free parameters without further simulations: likelihood of `response_model.h`, sample of `posterior.h`,
/// prior uniform within the bounds on the parameter's scale times the study's priors. Requirements: at least one
/// feasible simulation, `recommended` lies in the unit cube, at least one reading is fitted. Limit: the intervals
/// exclude errors of contact law and grain size.
Inference infer(const TrainingData& evidence, const UnitPoint& recommended, const InferenceOptions& options = {});

}  // namespace pastefit
