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

/// Why a material is the one that is recommended, for `Inference::recommended_because`.
std::string reason_for(bool confirmed, std::size_t packings);

/// Examines what a finished search leaves open: asks for other materials that may meet the laboratory as well, as far
/// apart as possible, each on one fresh packing; then, while simulations are left, for those that would be shown as
/// equivalent by prediction alone. Then infers. Central differences at the best candidate would cost as much and give
/// the slopes there only; these runs give them along the whole family, and test its members. Requirement: the
/// calibration's best candidate did not fail; it outlives the examination. The result depends only on what was asked: a
/// resumed calibration infers the same.
class Examination {
 public:
  /// `training_data`: what answers say. `simulations`: that may be spent, on points on one packing.
  Examination(std::function<TrainingData(std::span<const Response>)> training_data, const Calibration& calibration,
              int simulations, std::uint64_t seed);

  /// What to simulate next, all to its end on one packing.
  struct Request {
    std::vector<UnitPoint> points;
    std::uint64_t packing = 0;
  };
  /// Nothing once it is over. `affordable`: points on a packing that may still be simulated; 0 after a stop request.
  std::optional<Request> next(int affordable);
  /// The answers to the last request.
  void ingest(std::vector<Response> answers);
  /// Nothing, where no simulation has run to its end. Requirement: `next` gave nothing.
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

/// The same of a study, simulated by an objective; spends no more than its budget. Requirement: `objective` stores in
/// `store`. `conditions`: effects of the unstated ones.
std::optional<Inference> examine(const Study& study, Objective& objective, const Store& store,
                                 const Calibration& calibration, int simulations, std::uint64_t seed,
                                 const std::vector<ConditionEffect>& conditions = {});

/// Packings on which a material is simulated at either end of a condition's range.
inline constexpr std::size_t condition_packings = 2;

/// Simulates a point of a study in one of its tests, on these packings and in their order; fewer after a stop request.
using SimulatePoint = std::function<std::vector<StoredEvaluation>(
    const Study& study, const UnitPoint& point, std::span<const std::uint64_t> packings, std::size_t test)>;

/// Readings of a material at both ends of the range of each unstated condition, as long as there are simulations left
/// and no stop is requested. Requirement: at least one packing.
std::vector<ConditionEffect> condition_effects(const Study& study, const UnitPoint& material,
                                               std::span<const std::uint64_t> packings, int simulations,
                                               const SimulatePoint& simulate);

}  // namespace pastefit
