#include "calibrate/inference/examination.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "calibrate/evaluate/record.h"
#include "calibrate/search/strategy_state.h"
#include "calibrate/study/tests.h"

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
                   : "the best one found; it is not confirmed";
}

Examination::Examination(std::function<TrainingData(std::span<const Response>)> training_data,
                         const Calibration& calibration, int simulations, std::uint64_t seed)
    : training_data_(std::move(training_data)),
      calibration_(calibration),
      options_{.seed = seed},
      left_(simulations),
      history_(calibration.history) {}

std::optional<Examination::Request> Examination::next(bool stopped) {
  const TrainingData known = training_data_(history_);
  if (known.points.empty()) return std::nullopt;
  const UnitPoint& recommended = calibration_.best.point;
  Request request{{}, options_.seed * 1000 + first_examination_packing + round_};
  const int most = stopped ? 0 : left_;
  if (round_++ == 0) {
    const int half = most / 2;
    if (half > 0) request.points = candidates_to_examine(known, recommended, half, options_);
    if (request.points.empty()) return next(stopped);
  } else {
    inference_ = infer(known, recommended, options_);
    if (most > 0) request.points = predicted_members(*inference_);
    if (request.points.empty()) return std::nullopt;
  }
  request.points.resize(std::min(request.points.size(), static_cast<std::size_t>(most)));
  left_ -= static_cast<int>(request.points.size());
  return request;
}

void Examination::ingest(std::vector<Response> answers) {
  std::ranges::move(answers, std::back_inserter(history_));
}

std::optional<Inference> Examination::result() const {
  std::optional<Inference> inference = inference_;
  if (inference)
    inference->recommended_because =
        reason_for(calibration_.status == CalibrationStatus::confirmed, calibration_.confirmation.packings.size());
  return inference;
}

}  // namespace pastefit
