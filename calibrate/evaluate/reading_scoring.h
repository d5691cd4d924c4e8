#pragma once

#include <vector>

#include "calibrate/evaluate/objective.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"

namespace pastefit {

/// How simulations are judged against readings, and what is known of the parameters beforehand.
///
/// A candidate that failed on some packing answers as if every measurement had been missed by `factor` times
/// `largest_error`,
///     factor = 2 + mean over the packings of (1/(1 + t/1 s) if it failed at time t, else 0),
/// so that its misfit is finite, beyond any candidate that ran, and lower the later and the rarer the failure.
///
/// Requirement: every measurement has a standard deviation and a tolerance > 0 (std::logic_error).
class ReadingScoring : public virtual Scoring {
 public:
  ReadingScoring(std::vector<StudyReading> readings, const std::vector<Parameter>& parameters);

  int parameters() const override { return parameters_; }
  int residuals() const override;  ///< `readings` and one per prior; zero where the weight is zero
  int readings() const override { return static_cast<int>(readings_.size()); }
  double tolerance(std::size_t reading) const override { return readings_.at(reading).tolerance; }
  double allowance(std::size_t reading) const override;
  Response response_of(std::vector<Evaluation> evaluations) const override;

 protected:
  const std::vector<StudyReading>& scored() const { return readings_; }
  /// That a candidate can have in a reading, in its unit; > 0.
  virtual double largest_error(const StudyReading& reading) const = 0;
  /// Whether a value that ended its simulation early is an upper bound of what it would have read.
  virtual bool is_bound(const StudyReading&, double) const { return false; }

 private:
  /// Of a mean over packings some of which ended early: what it misses at least; none if it was not taken.
  double certain_miss(const Response& response, std::size_t reading) const;

  struct Known {
    Eigen::Index coordinate = 0;
    UnitPrior prior;
  };
  const std::vector<StudyReading> readings_;
  int parameters_ = 0;        // free ones
  std::vector<Known> known_;  // beforehand
};

}  // namespace pastefit
