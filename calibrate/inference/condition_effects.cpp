#include "calibrate/inference/condition_effects.h"

#include <algorithm>
#include <string>

#include "calibrate/evaluate/record.h"
#include "calibrate/study/tests.h"

namespace pastefit {

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
