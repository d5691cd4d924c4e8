#include "calibrate/inference/condition_effects.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "calibrate/evaluate/record.h"
#include "calibrate/study/tests.h"

namespace pastefit {
namespace {

/// The runs of one test at both ends of a condition, packing by packing.
struct RunsAtEnds {
  std::vector<StoredEvaluation> lower, upper;
};

bool is_usable(const StudyTest& test, const StoredEvaluation& run) {
  return !failure_of(test, run) && !is_rejected(test.lab.test, run.readings);
}

/// Means over the packings on which both heaps are accepted; returns their number.
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

/// Nothing after a stop request.
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
