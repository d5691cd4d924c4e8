#pragma once

#include <vector>

#include "calibrate/search/objective.h"
#include "calibrate/search/record.h"
#include "calibrate/store/store.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"
#include "calibrate/study/tolerance.h"

namespace pastefit {

/// How a study judges its simulations: against the readings of all tests that are fitted, and what is known beforehand.
///
/// A candidate that failed in some test on some packing answers as if every measurement had been missed by `factor`
/// times the largest error a heap can have (`ReadingKind::worst_miss`; without one ten standard deviations; at least
/// the measured value),
///     factor = 2 + mean over the packings of (1/(1 + t/1 s) if it failed at time t, else 0),
/// so that its misfit is finite, beyond any candidate that ran, and lower the later and the rarer the failure.
///
/// Requirements: `study` outlives the scoring; some test is fitted, and every measurement has a standard deviation and
/// a tolerance > 0 (std::logic_error).
class StudyScoring : public virtual Scoring {
 public:
  explicit StudyScoring(const Study& study);

  int parameters() const override;
  int residuals() const override;  ///< `readings` and one per prior; zero where the weight is zero
  int readings() const override { return static_cast<int>(readings_.size()); }
  int simulations_each() const override { return static_cast<int>(fitted_.size()); }
  double tolerance(std::size_t reading) const override { return readings_.at(reading).tolerance; }
  double allowance(std::size_t reading) const override;
  double rejected_share() const override { return rejected_share_of(study_); }
  MisfitUnit misfit_unit() const override { return misfit_unit_of(study_); }
  Response response_of(std::vector<Evaluation> evaluations) const override;

  /// What the store has of a candidate, merged over the tests, as the search sees it.
  Evaluation evaluation_of(const UnitPoint& point, const StoredEvaluation& stored) const;
  const std::vector<std::size_t>& fitted_tests() const { return fitted_; }

 private:
  /// Of a mean over packings some of which ended early: what it misses at least; none if it was not taken.
  double certain_miss(const Response& response, std::size_t reading) const;

  struct Known {
    Eigen::Index coordinate = 0;
    UnitPrior prior;
  };
  const Study& study_;
  const std::vector<StudyReading> readings_;
  const std::vector<std::size_t> fitted_;  // tests
  std::vector<Known> known_;               // beforehand
};

}  // namespace pastefit
