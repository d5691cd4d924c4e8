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

namespace {

using Runs = std::span<const StoredEvaluation>;

bool is_usable(const StudyTest& test, const StoredEvaluation& run) {
  return !failure_of(test, run) && !is_rejected(test.lab.test, run.readings);
}

/// Appends means over the packings on which both heaps are accepted; returns their number.
int add_means(const StudyTest& test, Runs lower, Runs upper, std::vector<ConditionEffect::Reading>& out) {
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < lower.size(); ++i)
    if (is_usable(test, lower[i]) && is_usable(test, upper[i])) usable.push_back(i);
  if (usable.empty()) return 0;
  const auto mean = [&](Runs runs, const std::string& reading) {
    double sum = 0;
    for (const std::size_t i : usable) sum += runs[i].readings.find(reading).value_or(0);
    return sum / static_cast<double>(usable.size());
  };
  for (const Measurement& one : test.lab.measurements)
    out.push_back({reading_name(test, one.reading), mean(lower, one.reading), mean(upper, one.reading)});
  return static_cast<int>(usable.size());
}

}  // namespace

std::vector<UnstatedCondition> affordable_conditions(const Study& study, std::size_t packings, int& simulations) {
  std::vector<UnstatedCondition> out;
  for (UnstatedCondition& condition : unstated_conditions(study)) {
    const int needed = static_cast<int>(2 * packings * condition.tests.size());
    if (needed > simulations) break;
    simulations -= needed;
    out.push_back(std::move(condition));
  }
  return out;
}

ConditionEffect effect_of(const Study& study, const UnstatedCondition& condition, Runs lower, Runs upper) {
  const std::size_t packings = lower.size() / condition.tests.size();
  ConditionEffect effect{condition.place,
                         condition.assumed,
                         condition.assumed / condition_range,
                         condition.assumed * condition_range,
                         static_cast<int>(packings),
                         {}};
  for (std::size_t i = 0; i < condition.tests.size(); ++i) {
    const int usable = add_means(study.tests[condition.tests[i]], lower.subspan(i * packings, packings),
                                 upper.subspan(i * packings, packings), effect.readings);
    effect.packings = std::min(effect.packings, usable);
  }
  return effect;
}

}  // namespace pastefit
