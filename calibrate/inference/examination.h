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
/// slopes only there; these simulations give slopes along the whole family and test its members. Requirements: the
/// calibration's best candidate did not fail; the calibration outlives the examination. The result depends only on the
/// answers: a resumed calibration infers the same.
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
  /// Next request; empty at the end. `stopped`: nothing more is simulated.
  std::optional<Request> next(bool stopped = false);
  void ingest(std::vector<Response> answers);
  /// The inference; empty if no simulation was completed. Requirement: `next` returned nothing.
  std::optional<Inference> result() const;

 private:
  const std::function<TrainingData(std::span<const Response>)> training_data_;
  const Calibration& calibration_;
  const InferenceOptions options_;
  int left_ = 0;
  std::uint64_t round_ = 0;
  std::vector<Response> history_;
  std::optional<Inference> inference_;
};

/// Packings simulated at each end of a condition's range.
inline constexpr std::size_t condition_packings = 2;

/// Unstated conditions, in order, as long as the simulations suffice for both ends of the range in every test; they are
/// taken from `simulations`.
std::vector<UnstatedCondition> affordable_conditions(const Study& study, std::size_t packings, int& simulations);

/// Effect of a condition. `lower`, `upper`: runs of a material at both ends of the range, test by test, each on the
/// same packings.
ConditionEffect effect_of(const Study& study, const UnstatedCondition& condition,
                          std::span<const StoredEvaluation> lower, std::span<const StoredEvaluation> upper);

}  // namespace pastefit
