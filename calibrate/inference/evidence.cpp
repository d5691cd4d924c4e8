#include "calibrate/inference/evidence.h"

#include <algorithm>
#include <cmath>

#include "calibrate/base/statistics.h"
#include "calibrate/search/early_end.h"
#include "calibrate/study/tests.h"

namespace pastefit {

Evidence evidence_of(const Study& study, std::span<const StoredEvaluation> evaluations) {
  Evidence evidence;
  for (const Parameter& parameter : study.parameters)
    if (parameter.free) evidence.parameters.push_back(parameter);
  std::vector<const StoredEvaluation*> good;
  for (const StoredEvaluation& evaluation : evaluations) {
    const auto count = static_cast<Eigen::Index>(evaluation.point.size());
    const UnitPoint point = Eigen::Map<const Eigen::VectorXd>(evaluation.point.data(), count);
    (evaluation.failure ? evidence.failed : evidence.points).push_back(point);
    if (!evaluation.failure) good.push_back(&evaluation);
  }
  if (good.empty()) return evidence;
  const std::vector<StudyReading> fitted = readings_of(study);
  const auto readings = [](const StoredEvaluation* one) { return one->observables.all().size(); };
  for (const Observable& reading : (*std::ranges::max_element(good, {}, readings))->observables.all()) {
    ReadingEvidence one;
    one.name = reading.name;
    one.simulated.resize(static_cast<Eigen::Index>(good.size()));
    for (std::size_t i = 0; i < good.size(); ++i)
      one.simulated[static_cast<Eigen::Index>(i)] = good[i]->observables.find(reading.name).value_or(std::nan(""));
    if ((one.simulated.array().isInf()).any()) continue;
    if (const auto known = std::ranges::find(fitted, reading.name, &StudyReading::name); known != fitted.end()) {
      for (std::size_t i = 0; i < good.size(); ++i)
        one.is_bound.push_back(good[i]->run.ended_early &&
                               is_upper_bound(study, known->test, known->measurement.observable,
                                              one.simulated[static_cast<Eigen::Index>(i)]));
      one.measured = known->measurement.value;
      one.deviation = known->measurement.standard_deviation;
      one.repeats = known->measurement.repeats;
      one.widening = widening(one.repeats);
      one.weight = known->weight;
    }
    evidence.readings.push_back(std::move(one));
  }
  return evidence;
}

}  // namespace pastefit
