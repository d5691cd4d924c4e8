#include "calibrate/card/card_study.h"

#include <algorithm>

#include "calibrate/study/parameters.h"

namespace pastefit {

Study study_of(const Card& card) {
  Study study;
  study.title = card.title;
  study.parameters = card.material.parameters;
  study.hash = card.provenance.study_hash;
  study.search.strategy = card.search.strategy;
  study.search.seed = card.search.seed;
  study.search.packings = static_cast<int>(card.search.packings.size());
  study.search.budget_simulations = card.search.budget;
  for (const CardTest& of_card : card.tests) {
    StudyTest test;
    test.name = of_card.name;
    test.lab_file = of_card.lab_file;
    test.hold_out = of_card.hold_out;
    test.lab.provenance = of_card.lab;
    test.lab.test = of_card.test;
    test.lab.hash = of_card.lab_hash;
    for (const CardReading& one : of_card.readings) {
      if (!one.measured) continue;
      test.lab.measurements.push_back({one.name, *one.measured, one.standard_deviation, one.repeats});
      test.targets.push_back({one.name, one.weight, one.tolerance});
    }
    study.tests.push_back(std::move(test));
  }
  return study;
}

Eigen::VectorXd point_of(const Card& card) {
  std::vector<double> point;
  for (const Parameter& parameter : card.material.parameters)
    if (parameter.free) point.push_back(std::clamp(unit_of(parameter, parameter.value), 0.0, 1.0));
  return Eigen::Map<const Eigen::VectorXd>(point.data(), std::ssize(point));
}

}  // namespace pastefit
