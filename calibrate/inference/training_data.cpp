#include "calibrate/inference/training_data.h"

#include <algorithm>
#include <cmath>

#include "calibrate/base/statistics.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

/// Rejection index of each simulation; empty if the study does not judge it.
std::vector<double> rejection_indices_of(const Study& study, const std::vector<const StoredEvaluation*>& simulations) {
  std::vector<double> indices;
  if (rejected_share_of(study) >= 1) return indices;
  const auto tests = tests_of(study, false);
  for (const StoredEvaluation* one : simulations) indices.push_back(rejection_index(study, tests, *one));
  return indices;
}

int most_repeats(const std::vector<StudyReading>& readings) {
  int most = 0;
  for (const StudyReading& reading : readings)
    if (reading.weight > 0) most = std::max(most, reading.measurement.repeats);
  return most;
}

std::size_t index_of_test(const Study& study, const std::string& name) {
  for (std::size_t test = 0; test < study.tests.size(); ++test)
    for (const ReadingKind& kind : reading_kinds(study.tests[test].lab.test))
      if (reading_name(study.tests[test], kind.name) == name) return test;
  return study.tests.size();
}

}  // namespace

TrainingData training_data_of(const Study& study, std::span<const StoredEvaluation> evaluations) {
  TrainingData evidence;
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
  evidence.rejection_indices = rejection_indices_of(study, good);
  evidence.accepted_heaps = most_repeats(fitted);
  const auto is_rejected = [&](std::size_t i) {
    return !evidence.rejection_indices.empty() && evidence.rejection_indices[i] > 1;
  };
  bool some_accepted = false;
  for (std::size_t i = 0; i < good.size(); ++i) some_accepted = some_accepted || !is_rejected(i);
  const auto readings = [](const StoredEvaluation* one) { return one->readings.all().size(); };
  for (const Reading& reading : (*std::ranges::max_element(good, {}, readings))->readings.all()) {
    ReadingTrainingData one;
    one.name = reading.name;
    one.test = index_of_test(study, reading.name);
    one.simulated.resize(good.size());
    for (std::size_t i = 0; i < good.size(); ++i)
      one.simulated[i] = good[i]->readings.find(reading.name).value_or(std::nan(""));
    if ((one.simulated.array().isInf()).any()) continue;
    for (std::size_t i = 0; some_accepted && i < good.size(); ++i)
      if (is_rejected(i)) one.simulated[i] = std::nan("");
    if (one.simulated.array().isNaN().all()) continue;
    if (const auto known = std::ranges::find(fitted, reading.name, &StudyReading::name); known != fitted.end()) {
      for (std::size_t i = 0; i < good.size(); ++i)
        one.is_bound.push_back(good[i]->run.ended_early &&
                               is_upper_bound(study, known->test, known->measurement.reading, one.simulated[i]));
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
