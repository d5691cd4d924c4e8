#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/inference/inference.h"
#include "calibrate/optimisers/problem.h"
#include "calibrate/search/search.h"
#include "calibrate/store/store.h"
#include "calibrate/study/unstated_conditions.h"

namespace pastefit {

/// Text for `Inference::recommended_because`.
std::string reason_for(bool confirmed, std::size_t packings);

/// Simulates after a search to find equivalent materials, then infers. It requests candidates that may fit equally
/// well, as far apart as possible, each on one fresh packing; then, while simulations remain, those that would be
/// listed as equivalent by prediction only. Central differences at the best candidate would cost as much and give
/// slopes there only; these runs give them along the whole family and test its members. Requirements: the calibration's
/// best candidate did not fail; the calibration outlives the examination. The result depends only on the answers: a
/// resumed calibration infers the same.
class Examination {
 public:
  /// `training_data`: converts responses. `simulations`: points on one packing that may be spent.
  Examination(std::function<TrainingData(std::span<const Response>)> training_data, const Calibration& calibration,
              int simulations, std::uint64_t seed);

  /// Points to simulate completely on one packing.
  struct Request {
    std::vector<UnitPoint> points;
    std::uint64_t packing = 0;
  };
  /// Next request; empty at the end. `affordable`: points on a packing still allowed; 0 after a stop request.
  std::optional<Request> next(int affordable);
  /// Takes the answers to the last request.
  void ingest(std::vector<Response> answers);
  /// The inference; empty if no simulation was completed. Requirement: `next` returned nothing.
  std::optional<Inference> result() const;

 private:
  const std::function<TrainingData(std::span<const Response>)> training_data_;
  const Calibration& calibration_;
  const InferenceOptions options_;
  const int simulations_;
  int left_ = 0;
  std::uint64_t round_ = 0;
  std::vector<Response> history_;
  std::optional<Inference> inference_;
};

/// Runs the examination of a study with an objective, within its budget. Requirement: `objective` stores in `store`.
/// `conditions`: effects of unstated conditions.
std::optional<Inference> examine(const Study& study, Objective& objective, const Store& store,
                                 const Calibration& calibration, int simulations, std::uint64_t seed,
                                 const std::vector<ConditionEffect>& conditions = {});

/// Packings simulated at each end of a condition's range.
inline constexpr std::size_t condition_packings = 2;

/// Simulates a point in one test of a study, on these packings in their order; fewer results after a stop request.
using SimulatePoint = std::function<std::vector<StoredEvaluation>(
    const Study& study, const UnitPoint& point, std::span<const std::uint64_t> packings, std::size_t test)>;

/// Readings of a material at both ends of the range of each unstated condition, while simulations remain and no stop is
/// requested. Requirement: at least one packing.
std::vector<ConditionEffect> condition_effects(const Study& study, const UnitPoint& material,
                                               std::span<const std::uint64_t> packings, int simulations,
                                               const SimulatePoint& simulate);

}  // namespace pastefit
