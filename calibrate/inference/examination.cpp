#include "calibrate/inference/examination.h"

#include <algorithm>

#include "calibrate/search/record.h"

namespace pastefit {

namespace {

constexpr int rounds = 2;
constexpr std::uint64_t first_packing = 900;  // beyond any the search of the same seed uses

}  // namespace

std::string reason_for(bool confirmed, std::size_t packings) {
  return confirmed ? "which was confirmed on " + std::to_string(packings) + " fresh packings"
                   : "the best that was found; it is not confirmed";
}

std::optional<Inference> examine(const Study& study, Objective& objective, const Store& store,
                                 const Calibration& calibration, int simulations, std::uint64_t seed) {
  std::vector<Response> history = calibration.history;
  InferenceOptions options;
  options.seed = seed;
  const auto training_data = [&] { return training_data_of(study, record_of(study, store, history)); };
  if (training_data().points.empty()) return std::nullopt;
  for (int round = 0; round < rounds; ++round) {
    const int count = std::min(simulations / rounds, objective.budget_left());
    if (count < 1 || objective.stop_requested()) break;
    const std::uint64_t packing = seed * 1000 + first_packing + static_cast<std::uint64_t>(round);
    const auto points = candidates_to_examine(training_data(), calibration.best.point, count, options);
    for (Response& response : objective.evaluate(points, {&packing, 1})) history.push_back(std::move(response));
  }
  Inference inference = infer(training_data(), calibration.best.point, options);
  inference.recommended_because =
      reason_for(calibration.status == CalibrationStatus::confirmed, calibration.confirmation.packings.size());
  return inference;
}

}  // namespace pastefit
