#pragma once

#include <string>
#include <vector>

#include "calibrate/study/study.h"

namespace pastefit {

/// Test condition that affects the readings, but is stated neither in the laboratory files nor in the study: a value
/// from the preset (`Dimension::often_unstated`), or the default sliding friction of a surface.
struct UnstatedCondition {
  std::string place;               ///< in the files: "apparatus.lift_velocity_mm_s", "parameters.mould_friction"
  std::string field;               ///< path in the test's JSON, or name of the parameter
  std::vector<std::size_t> tests;  ///< indices of the tests in which it acts
  double assumed = 0;              ///< in the unit of `place`
  bool parameter = false;          ///< parameter of the study; otherwise a dimension of the apparatus
};

/// Factor by which an unstated condition may be larger or smaller than assumed. Standard lifts of an Abrams cone are 43
/// to 150 mm/s (ASTM C143: 300 mm in 5 +- 2 s; EN 12350-2: in 2 to 5 s); the preset has 100.
inline constexpr double condition_range = 2;

/// Unstated conditions of the fitted tests, in order.
std::vector<UnstatedCondition> unstated_conditions(const Study& study);

/// The study with the condition multiplied by `factor`; unchanged if its tests do not admit the value.
Study with_condition(Study study, const UnstatedCondition& condition, double factor);

/// Effect of a condition within its range on the readings of a material: means over the same packings, without rejected
/// heaps.
struct ConditionEffect {
  struct Reading {
    std::string name;  ///< in the study
    double at_lower = 0, at_upper = 0;
  };
  std::string place;
  double assumed = 0, lower = 0, upper = 0;  ///< in the unit of `place`
  int packings = 0;                          ///< averaged; 0: on none of them both heaps were accepted
  std::vector<Reading> readings;
};

}  // namespace pastefit
