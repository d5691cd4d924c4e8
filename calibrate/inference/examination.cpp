#include "calibrate/inference/examination.h"

#include <algorithm>

#include "calibrate/search/record.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {

namespace {

std::vector<UnitPoint> predicted_members(const Inference& inference) {
  std::vector<UnitPoint> points;
  for (const EquivalentMaterial& member : inference.family)
    if (!member.simulated) points.push_back(member.point);
  return points;
}

}  // namespace

std::string reason_for(bool confirmed, std::size_t packings) {
  return confirmed ? "which was confirmed on " + std::to_string(packings) + " fresh packings"
                   : "the best that was found; it is not confirmed";
}

std::optional<Inference> examine(const std::function<TrainingData(std::span<const Response>)>& evidence,
                                 Objective& objective, const Calibration& calibration, int simulations,
                                 std::uint64_t seed) {
  std::vector<Response> history = calibration.history;
  InferenceOptions options;
  options.seed = seed;
  const auto training_data = [&] { return evidence(history); };
  if (training_data().points.empty()) return std::nullopt;
  int left = simulations;
  const auto affordable = [&] { return objective.stop_requested() ? 0 : std::min(left, objective.budget_left()); };
  const auto simulate = [&](std::vector<UnitPoint> points, std::uint64_t round) {
    points.resize(std::min(points.size(), static_cast<std::size_t>(affordable())));
    const std::uint64_t packing = seed * 1000 + first_examination_packing + round;
    for (Response& response : objective.evaluate(points, {&packing, 1})) history.push_back(std::move(response));
    left -= static_cast<int>(points.size());
  };
  const UnitPoint& recommended = calibration.best.point;
  if (const int count = std::min(simulations / 2, affordable()); count > 0)
    simulate(candidates_to_examine(training_data(), recommended, count, options), 0);
  Inference inference = infer(training_data(), recommended, options);
  for (std::uint64_t round = 1; affordable() > 0; ++round) {
    const std::vector<UnitPoint> predicted = predicted_members(inference);
    if (predicted.empty()) break;
    simulate(predicted, round);
    inference = infer(training_data(), recommended, options);
  }
  inference.recommended_because =
      reason_for(calibration.status == CalibrationStatus::confirmed, calibration.confirmation.packings.size());
  return inference;
}

std::optional<Inference> examine(const Study& study, Objective& objective, const Store& store,
                                 const Calibration& calibration, int simulations, std::uint64_t seed,
                                 const std::vector<ConditionEffect>& conditions) {
  const auto evidence = [&](std::span<const Response> history) {
    TrainingData known = training_data_of(study, record_of(study, store, history));
    known.conditions = conditions;
    return known;
  };
  return examine(evidence, objective, calibration, simulations, seed);
}

}  // namespace pastefit
