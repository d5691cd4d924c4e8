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

/// Scores simulations against the readings of all fitted tests and the priors of a study. The largest error of a failed
/// candidate is `ReadingKind::worst_miss`, without one ten standard deviations; at least the measured value.
class StudyScoring : public ReadingScoring {
 public:
  explicit StudyScoring(const Study& study);

  int simulations_each() const override { return static_cast<int>(fitted_.size()); }
  double rejected_share() const override { return rejected_share_of(study_); }
  ErrorUnit error_unit() const override { return error_unit_of(study_); }
  /// Strengths for which every fitted test is likely to have its measured readings (`likely_strength_pa`); the whole
  /// range if tests contradict each other or the bounds.
  UnitBox likely_box() const override;

  /// Evaluation of a stored candidate, merged over the tests.
  Evaluation evaluation_of(const UnitPoint& point, const StoredEvaluation& stored) const;
  const std::vector<std::size_t>& fitted_tests() const { return fitted_; }

 protected:
  double largest_error(const StudyReading& reading) const override;
  bool is_bound(const StudyReading& reading, double value) const override;

 private:
  const Study& study_;
  const std::vector<std::size_t> fitted_;  // indices of tests
};

struct Measurement;
struct Study;

/// Largest factor on the worst miss of a failed candidate (`ReadingScoring`).
inline constexpr double worst_factor = 3;

/// Largest possible error of a heap, in the measurement's unit. Requirement: `test` is an index of `study.tests`.
double worst_miss(const Study& study, std::size_t test, const Measurement& measurement);

/// Errors for every prior and fitted reading whose residual, or its square, is not finite somewhere within the bounds,
/// with places as in study and laboratory files. A study read from a file has none, because its numbers have ranges; a
/// study made by a program may.
Faults validate_residuals(const Study& study);

}  // namespace pastefit
