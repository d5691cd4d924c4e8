#pragma once

#include <optional>
#include <vector>

#include "calibrate/inference/training_data.h"
#include "calibrate/models/exceedance.h"
#include "calibrate/models/gaussian_process.h"
#include "calibrate/models/reading_model.h"

namespace pastefit {

/// What a simulation of any candidate is likely to read, learnt from the evidence: a model for each reading
/// (`ReadingModel`), a Gaussian process for the share of failures, and one of how near heaps come to being rejected
/// (`Exceedance`): that a laboratory reports n heaps is worth n log(1 - p), p the probability that one is rejected.
/// Readings of one heap are correlated: a heap that happens to stay high is narrow. The correlation is learnt from the
/// fillings of the same candidates, drawn towards none by three heaps' worth of predictive_variance. It is none between
/// tests. The likelihood of a candidate follows: the laboratory's means are off the mean answers of the simulations by
/// the laboratory's own errors and by what is not known of those answers, normal with
///     C = L + M,   M_jk = (predictive_variance of the two means: that of j for j = k; else what the same heaps brought
///     into both), L_jj = laboratory's variance of j,   L_jk = r_jk min(s_j, l_j) min(s_k, l_k) min(n_j, n_k)/(n_j
///     n_k);
/// r: correlation, s: deviation of one simulation at the candidate, l and n: the laboratory's deviation and repeats.
/// What the laboratory's deviation is more than s is the ruler's, and not correlated. A condition that the laboratory
/// does not state adds e_j e_k/12 to L_jk, e what it moves a reading by from one end of its range to the other: it may
/// lie anywhere there, evenly on a logarithmic scale. With d the differences, the
/// logarithm of the likelihood is
///     -(d' C^-1 d + log det L + n/N (log det C - log det L))/2,   n = (tr R)^2/tr(R^2),
/// R the correlation of the N readings over all simulations: so many of them are independent. Two heights and two
/// spreads of one heap are nearly one number; a candidate that little is known of would lose by its predictive_variance
/// once for each of them, and all that was never looked at would seem to be ruled out. Requirement: at least one
/// simulation ended well.
class ResponseModel {
 public:
  explicit ResponseModel(TrainingData evidence);

  const TrainingData& training_data() const { return evidence_; }
  /// Mean reading of a candidate, and the variance of what is known of it.
  ReadingModel::Prediction predict(std::size_t reading, const UnitPoint& point) const;
  /// Standard deviation of the reading of one simulation about its mean, at this candidate.
  double noise(std::size_t reading, const UnitPoint& point) const;
  /// The readings that are fitted, as indices.
  const std::vector<std::size_t>& fitted() const { return fitted_; }
  /// Between the readings of one heap. Shape: fitted readings x fitted readings.
  const Eigen::MatrixXd& correlation() const { return correlation_; }
  /// C of a candidate. Shape: fitted readings x fitted readings.
  Eigen::MatrixXd covariance(const UnitPoint& point) const;
  /// Distance of the mean readings from the laboratory, and of the point from what was known beforehand: root of the
  /// sum of squares, each in standard deviations, of one measurement or of the prior.
  double normalised_error(const UnitPoint& point) const;
  double log_likelihood(const UnitPoint& point) const;
  /// The same, and what was known beforehand.
  double log_posterior(const UnitPoint& point) const;

 private:
  /// Rows of two readings that are of the same heaps.
  struct Shared {
    Eigen::Index row_of_first = 0, row_of_second = 0;
    double covariance = 0;  ///< of the noise of the two
  };

  void learn_rejections();
  void learn_correlation(const std::vector<std::size_t>& sites);
  void count_independent();
  void find_shared();
  void take_conditions();
  Eigen::MatrixXd errors_of_laboratory(const std::vector<ReadingModel::Prediction>& predictions) const;  // L
  Eigen::MatrixXd predictive_variance(const std::vector<ReadingModel::Prediction>& predictions) const;   // M
  std::vector<ReadingModel::Prediction> predictions(const UnitPoint& point) const;

  TrainingData evidence_;
  std::vector<ReadingModel> models_;
  std::vector<std::size_t> fitted_;
  Eigen::MatrixXd correlation_;
  Eigen::MatrixXd of_conditions_;                         // what unstated ones add to L
  double independent_ = 1;                                // n/N
  std::vector<std::vector<std::vector<Shared>>> shared_;  // of each fitted reading with those before it
  std::optional<GaussianProcess> failures_;
  std::optional<Exceedance> rejections_;
};

}  // namespace pastefit
