#pragma once

#include <string>
#include <vector>

#include "calibrate/study/study.h"

namespace pastefit {

/// A condition of the tests that moves the readings and that neither the laboratory files nor the study state: what an
/// apparatus has by its preset (`Dimension::often_unstated`), and the sliding friction of its surfaces where it is the
/// default.
struct UnstatedCondition {
  std::string place;               ///< in the files: "apparatus.lift_velocity_mm_s", "parameters.mould_friction"
  std::string field;               ///< path in the test's JSON, or the parameter's name
  std::vector<std::size_t> tests;  ///< of the study, where it acts
  double assumed = 0;              ///< in the unit of the place
  bool parameter = false;          ///< of the study; else of the apparatus
};

/// An unstated condition may be as much as this times larger or smaller than what is assumed. The standards' lifts of
/// an Abrams cone are 43 to 150 mm/s (ASTM C143: 300 mm in 5 +- 2 s; EN 12350-2: in 2 to 5 s) about a preset of 100.
inline constexpr double condition_range = 2;

/// Those of the tests that are fitted, in the order of the tests.
std::vector<UnstatedCondition> unstated_conditions(const Study& study);

/// The study with the condition so many times as large; as it is, where its tests admit no such value.
Study with_condition(Study study, const UnstatedCondition& condition, double factor);

/// What a condition within its range does to the readings of a material: means over the same packings, heaps that a
/// laboratory would reject left out.
struct ConditionEffect {
  struct Reading {
    std::string name;  ///< in the study
    double at_lower = 0, at_upper = 0;
  };
  std::string place;
  double assumed = 0, lower = 0, upper = 0;  ///< in the unit of the place
  int packings = 0;                          ///< behind the means; 0: on none would both heaps be accepted
  std::vector<Reading> readings;
};

}  // namespace pastefit
