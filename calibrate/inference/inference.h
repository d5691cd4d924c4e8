#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/inference/combination.h"
#include "calibrate/inference/equivalent_material.h"
#include "calibrate/inference/measurement_gain.h"
#include "calibrate/inference/parameter_interval.h"
#include "calibrate/inference/training_data.h"

namespace pastefit {

/// What a calibration knows, and what it does not.
struct Inference {
  std::vector<std::string> fitted;               ///< the readings behind it
  std::vector<double> noise;                     ///< standard deviation of each in one simulation of the
                                                 ///< recommended candidate, from packing to packing
  std::vector<ParameterInterval> intervals;      ///< of the free parameters, in their order
  std::vector<std::vector<double>> correlation;  ///< of the free parameters, after the measurement
  std::vector<Combination> combinations;         ///< best determined first; one for each free parameter
  bool linear = false;                           ///< the combinations explain the intervals; if not, the
                                                 ///< intervals rule
  std::vector<EquivalentMaterial> family;        ///< spread out; the recommended one first
  std::vector<MeasurementGain> gains;            ///< best first
  std::vector<ConditionEffect> conditions;       ///< that nobody states, and what they move; contained in the intervals
  std::string recommended_because;               ///< why the first of the family is the one
  int simulations = 0;                           ///< behind all of it
};

struct InferenceOptions {
  int sample = 3000;  ///< candidates drawn in proportion to their likelihood
  int family = 5;     ///< equivalent materials shown, the recommended one included
  int repeats = 5;    ///< further measurements a gain is predicted for
  std::uint64_t seed = 1;
};

/// Candidates whose simulation would tell most: drawn from those that may meet the laboratory, as far from each other
/// and from `recommended` as can be. Shape: `count` points, fewer if the evidence leaves no choice.
std::vector<UnitPoint> candidates_to_examine(const TrainingData& evidence, const UnitPoint& recommended, int count,
                                             const InferenceOptions& options = {});

/// What the evidence says about the parameters of a study, without further
/// simulations. See `response_model.h` for the likelihood, `posterior.h` for the
/// sample. Bounds count as prior knowledge, evenly spread on the parameter's scale, or by its prior if the study gives
/// one. Limits: the law itself is taken as right, and so is its grain size;
/// what both are off is in none of the intervals. Requirements: some simulation
/// ended well, `recommended` lies in the unit cube, some reading is fitted.
Inference infer(const TrainingData& evidence, const UnitPoint& recommended, const InferenceOptions& options = {});

}  // namespace pastefit
