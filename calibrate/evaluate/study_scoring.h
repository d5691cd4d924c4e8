#pragma once

#include <vector>

#include "calibrate/evaluate/reading_scoring.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"
#include "calibrate/study/tolerance.h"
#include "core/result.h"

namespace pastefit {

/// How a study judges its simulations: against the readings of all tests that are fitted, and what is known beforehand.
/// The largest error of a candidate that failed is what a heap can have (`ReadingKind::worst_miss`; without one ten
/// standard deviations; at least the measured value).
///
/// Requirements: `study` outlives the scoring; some test is fitted (std::logic_error); those of `ReadingScoring`.
class StudyScoring : public ReadingScoring {
 public:
  explicit StudyScoring(const Study& study);

  int simulations_each() const override { return static_cast<int>(fitted_.size()); }
  double rejected_share() const override { return rejected_share_of(study_); }
  ErrorUnit error_unit() const override { return error_unit_of(study_); }
  /// Strengths with which every fitted test is likely to have its readings (`likely_strength_pa`); all, where tests
  /// contradict each other or the bounds.
  UnitBox likely_box() const override;

  /// What the store has of a candidate, merged over the tests, as the search sees it.
  Evaluation evaluation_of(const UnitPoint& point, const StoredEvaluation& stored) const;
  const std::vector<std::size_t>& fitted_tests() const { return fitted_; }

 protected:
  double largest_error(const StudyReading& reading) const override;
  bool is_bound(const StudyReading& reading, double value) const override;

 private:
  const Study& study_;
  const std::vector<std::size_t> fitted_;  // tests
};

struct Measurement;
struct Study;

/// By how many worst misses a failed candidate is off at most (`SimulationObjective`).
inline constexpr double worst_factor = 3;

/// The largest error a heap can have, in the measurement's unit. Requirement: `test` is an index of `study.tests`.
double worst_miss(const Study& study, std::size_t test, const Measurement& measurement);

/// Every prior and every fitted reading whose residual, or its square, is not finite somewhere between the bounds,
/// places as in study and laboratory files. A study that was read has none (its numbers have ranges); one that a
/// program put together may.
Faults validate_residuals(const Study& study);

}  // namespace pastefit
