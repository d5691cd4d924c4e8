#pragma once

#include <optional>
#include <vector>

#include "calibrate/inference/surrogate_trust.h"
#include "calibrate/inference/training_data.h"
#include "calibrate/models/exceedance.h"
#include "calibrate/models/gaussian_process.h"
#include "calibrate/models/reading_model.h"

namespace pastefit {

/// What a simulation of any candidate is likely to read, learnt from the evidence: a model for each reading
/// (`ReadingModel`), a Gaussian process for the probability of a failure, and one for the probability p that a heap is
/// rejected (`Exceedance`): n heaps that the laboratory reports add n log(1 - p) to the log-likelihood.
///
/// Readings of one heap are correlated: a heap that happens to stay high is narrow. The correlation r is estimated from
/// the packings of the same candidates and shrunk towards zero, as if three further heaps had shown none. Readings of
/// different tests are uncorrelated.
///
/// The differences d between the predicted mean readings of a candidate and the laboratory's means are normal, with
/// mean zero and covariance C = L + M:
///     M_jj   predictive variance of mean reading j; M_jk the covariance of two of them by the noise of the heaps that
///            both are learnt from;
///     L_jj = variance of the laboratory's mean of reading j,
///     L_jk = r_jk min(s_j, l_j) min(s_k, l_k)/max(n_j, n_k);
/// s: standard deviation of one simulation at the candidate; l, n: the laboratory's standard deviation of one
/// measurement and its repeats. Where l exceeds s the rest is error of the measurement itself, which is not correlated.
/// A condition that the laboratory does not state adds e_j e_k/12 to L_jk, e the change of a reading from one end of
/// the condition's range to the other: the variance of a condition that is uniform on a logarithmic scale. The
/// log-likelihood is, up to a constant,
///     -(d' C^-1 d + log det L + n/N (log det C - log det L))/2,   n = (tr R)^2/tr(R^2),
/// R the correlation matrix of the N fitted readings over all simulations, n the effective number of independent ones.
/// Two heights and two spreads of one heap are nearly one number: without the factor n/N a candidate of large
/// predictive variance would lose likelihood for each of them, and regions without simulations would seem to be ruled
/// out. Where one parameter is free and the response jumps, neighbouring simulations take the place of the models
/// (`SurrogateTrust`). Requirement: at least one simulation ended well.
class ResponseModel {
 public:
  explicit ResponseModel(TrainingData evidence);

  const TrainingData& training_data() const { return evidence_; }
  /// Mean reading of a candidate, and its predictive variance.
  ReadingModel::Prediction predict(std::size_t reading, const UnitPoint& point) const;
  /// The reading to expect of a candidate: of the model, and where that may not predict, of its own simulations if
  /// there are any.
  double expected(std::size_t reading, const UnitPoint& point) const;
  /// Whether `expected` may be told to a person: the model may predict the candidate, or it was simulated.
  bool is_known(const UnitPoint& point) const;
  /// Standard deviation of the reading of one simulation about its mean, at this candidate.
  double noise(std::size_t reading, const UnitPoint& point) const;
  /// The readings that are fitted, as indices.
  const std::vector<std::size_t>& fitted() const { return fitted_; }
  /// Between the readings of one heap. Shape: fitted readings x fitted readings.
  const Eigen::MatrixXd& correlation() const { return correlation_; }
  /// C of a candidate. Shape: fitted readings x fitted readings.
  Eigen::MatrixXd covariance(const UnitPoint& point) const;
  /// Distance of a candidate from laboratory and priors [1]: root of the sum of squares of the weighted differences of
  /// the mean readings, in standard deviations of one measurement, and of the coordinates from the means of their
  /// priors, in standard deviations of those.
  double distance(const UnitPoint& point) const;
  double log_likelihood(const UnitPoint& point) const;
  /// The log-likelihood plus the logarithm of the priors, up to a constant.
  double log_posterior(const UnitPoint& point) const;
  /// Where the models of the fitted readings may be believed.
  const SurrogateTrust& trust() const { return *trust_; }

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
  std::optional<SurrogateTrust> trust_;
};

}  // namespace pastefit
