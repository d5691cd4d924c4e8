#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/inference/training_data.h"

namespace pastefit {

/// What the data say about one free parameter, in its own unit.
struct ParameterInterval {
  std::string name;
  Scale scale = Scale::linear;
  double bound_lower = 0, bound_upper = 0;  ///< of the study
  double recommended = 0;
  double lower = 0, upper = 0;  ///< 95 %, all parameters free; the study's bound
                                ///< where the data set none
  bool lower_known = false,
       upper_known = false;  ///< the end was set by the data, not by the study's bound
  double held_lower = 0,
         held_upper = 0;        ///< 95 %, the other parameters held at the recommended values
  std::optional<Prior> prior;   ///< what was known beforehand, contained in all of these
  double deviation_before = 0;  ///< of its coordinate, by the bounds and the prior alone
  double uncertainty = 1;       ///< standard deviation after the measurement over that one

  bool interval_exists() const { return lower_known && upper_known; }
  bool not_identified() const { return !lower_known && !upper_known; }
};

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

/// A candidate that meets the laboratory as well as any other, as far as is
/// known.
struct EquivalentMaterial {
  UnitPoint point;
  std::vector<double> values;    ///< of the free parameters
  std::vector<double> readings;  ///< predicted, in the order of `Inference::fitted`
  bool simulated = false;        ///< else predicted from its neighbours
  double normalised_error = 0;   ///< root of the sum of squares, each in standard deviations of one measurement
};

/// What further measurements would bring.
struct MeasurementGain {
  std::string reading;
  int measurements = 0;       ///< how many, by the same person
  double deviation = 0;       ///< of one of them, in the reading's unit
  std::string parameter;      ///< that gains most
  double narrowing = 1;       ///< its standard deviation after over before
  double lead_narrowing = 1;  ///< the same of the parameter that leads the best
                              ///< determined combination
};

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
