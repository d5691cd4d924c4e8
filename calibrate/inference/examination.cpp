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
                   : "the best that was found; it is not confirmed";
}

Examination::Examination(std::function<TrainingData(std::span<const Response>)> training_data,
                         const Calibration& calibration, int simulations, std::uint64_t seed)
    : training_data_(std::move(training_data)),
      calibration_(calibration),
      options_{.seed = seed},
      simulations_(simulations),
      left_(simulations),
      history_(calibration.history) {}

std::optional<Examination::Request> Examination::next(int affordable) {
  const TrainingData known = training_data_(history_);
  if (known.points.empty()) return std::nullopt;
  const UnitPoint& recommended = calibration_.best.point;
  Request request{{}, options_.seed * 1000 + first_examination_packing + round_};
  const int most = std::min(left_, affordable);
  if (round_++ == 0) {
    const int count = std::min(simulations_ / 2, most);
    if (count > 0) request.points = candidates_to_examine(known, recommended, count, options_);
    if (request.points.empty()) return next(affordable);
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

std::optional<Inference> examine(const Study& study, Objective& objective, const Store& store,
                                 const Calibration& calibration, int simulations, std::uint64_t seed,
                                 const std::vector<ConditionEffect>& conditions) {
  const auto training_data = [&](std::span<const Response> history) {
    TrainingData known = training_data_of(study, record_of(study, store, history));
    known.conditions = conditions;
    return known;
  };
  Examination examination(training_data, calibration, simulations, seed);
  const auto affordable = [&] { return objective.stop_requested() ? 0 : objective.budget_left(); };
  while (const auto request = examination.next(affordable()))
    examination.ingest(objective.evaluate(request->points, {&request->packing, 1}));
  return examination.result();
}

namespace {

/// The runs of one test at both ends of a condition, packing by packing.
struct RunsAtEnds {
  std::vector<StoredEvaluation> lower, upper;
};

bool is_usable(const StudyTest& test, const StoredEvaluation& run) {
  return !failure_of(test, run) && !is_rejected(test.lab.test, run.readings);
}

/// Appends means over the packings on which both heaps are accepted; returns their number.
int add_means(const StudyTest& test, const RunsAtEnds& ends, std::vector<ConditionEffect::Reading>& out) {
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < std::min(ends.lower.size(), ends.upper.size()); ++i)
    if (is_usable(test, ends.lower[i]) && is_usable(test, ends.upper[i])) usable.push_back(i);
  if (usable.empty()) return 0;
  const auto mean = [&](const std::vector<StoredEvaluation>& runs, const std::string& reading) {
    double sum = 0;
    for (const std::size_t i : usable) sum += runs[i].readings.find(reading).value_or(0);
    return sum / static_cast<double>(usable.size());
  };
  for (const Measurement& one : test.lab.measurements)
    out.push_back({reading_name(test, one.reading), mean(ends.lower, one.reading), mean(ends.upper, one.reading)});
  return static_cast<int>(usable.size());
}

/// Empty after a stop request.
std::optional<ConditionEffect> effect_of(const Study& study, const UnstatedCondition& condition,
                                         const UnitPoint& material, std::span<const std::uint64_t> packings,
                                         const SimulatePoint& simulate) {
  ConditionEffect effect{condition.place,
                         condition.assumed,
                         condition.assumed / condition_range,
                         condition.assumed * condition_range,
                         static_cast<int>(packings.size()),
                         {}};
  const Study lower = with_condition(study, condition, 1 / condition_range);
  const Study upper = with_condition(study, condition, condition_range);
  for (const std::size_t test : condition.tests) {
    const RunsAtEnds ends{simulate(lower, material, packings, test), simulate(upper, material, packings, test)};
    if (std::min(ends.lower.size(), ends.upper.size()) < packings.size()) return std::nullopt;
    effect.packings = std::min(effect.packings, add_means(study.tests[test], ends, effect.readings));
  }
  return effect;
}

}  // namespace

std::vector<ConditionEffect> condition_effects(const Study& study, const UnitPoint& material,
                                               std::span<const std::uint64_t> packings, int simulations,
                                               const SimulatePoint& simulate) {
  std::vector<ConditionEffect> effects;
  for (const UnstatedCondition& condition : unstated_conditions(study)) {
    simulations -= static_cast<int>(2 * packings.size() * condition.tests.size());
    if (simulations < 0) break;
    auto effect = effect_of(study, condition, material, packings, simulate);
    if (!effect) break;
    effects.push_back(std::move(*effect));
  }
  return effects;
}

}  // namespace pastefit
