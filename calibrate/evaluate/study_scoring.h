#pragma once

#include <vector>

#include "calibrate/evaluate/record.h"
#include "calibrate/evaluate/response.h"
#include "calibrate/store/store.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"
#include "core/result.h"

namespace pastefit {

/// Scores simulations against readings and priors.
///
/// Requirement: every measurement has a standard deviation and a tolerance > 0 (std::logic_error).
///
/// A candidate that failed on some packing is scored as if every reading differed from its measurement by `factor`
/// times `largest_error`,
///     factor = 2 + mean over the packings of (1/(1 + t/1 s) if it failed at time t, else 0).
/// Its misfit is thus finite, larger than that of any finished candidate, and lower the later and rarer the failure.
class ReadingScoring : public virtual Scoring {
 public:
  ReadingScoring(std::vector<StudyReading> readings, const std::vector<Parameter>& parameters);

  int parameters() const override { return parameters_; }
  int residuals() const override;  ///< readings, then priors; zero for weight zero
  int readings() const override { return static_cast<int>(readings_.size()); }
  double tolerance(std::size_t reading) const override { return readings_.at(reading).tolerance; }
  double allowance(std::size_t reading) const override;
  Response response_of(std::vector<Evaluation> evaluations) const override;

 protected:
  const std::vector<StudyReading>& scored() const { return readings_; }
  /// Largest error of a reading, in its unit: the measured value, or ten standard deviations if that is more.
  virtual double largest_error(const StudyReading& reading) const;
  /// True if a value is an upper bound because its simulation ended early.
  virtual bool is_bound(const StudyReading&, double) const { return false; }

 private:
  /// Lower bound of the miss of a mean over packings some of which ended early; 0 if the reading was not taken.
  double certain_miss(const Response& response, std::size_t reading) const;

  struct Known {
    Eigen::Index coordinate = 0;
    UnitPrior prior;
  };
  const std::vector<StudyReading> readings_;
  int parameters_ = 0;        // free ones
  std::vector<Known> known_;  // priors
};

/// Scores simulations against the readings of all fitted tests and the priors of a study. The largest error of a failed
/// candidate is `ReadingKind::worst_miss`, if there is one; at least the measured value.
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

/// Errors for every prior and fitted reading whose residual, or its square, is not finite somewhere within the bounds,
/// with places as in study and laboratory files. A study read from a file has none, because its numbers have ranges; a
/// study made by a program may.
Faults validate_residuals(const Study& study);

}  // namespace pastefit
