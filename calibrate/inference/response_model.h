#pragma once

#include <optional>
#include <vector>

#include "calibrate/inference/surrogate_trust.h"
#include "calibrate/inference/training_data.h"
#include "calibrate/models/gaussian_process.h"
#include "calibrate/models/reading_model.h"

namespace pastefit {

/// Predicts the readings of any candidate from the training data: a `ReadingModel` for each reading, a Gaussian process
/// for the probability of a failure, and an `Exceedance` for the probability p that a heap is rejected: n heaps
/// reported by the laboratory add n log(1 - p) to the log-likelihood. Requirement: at least one feasible simulation.
///
/// Readings of one heap are correlated: a heap that stays high is narrow. The correlation r is estimated from
/// replicates and shrunk towards zero as if three further heaps had shown none. Readings of different tests are
/// uncorrelated.
///
/// The differences d between the predicted mean readings of a candidate and the measured means are normal, with mean
/// zero and covariance C = L + M:
///     M_jj   predictive variance of mean reading j; M_jk the covariance of two of them by the noise of the heaps that
///            both are trained on;
///     L_jj = variance of the measured mean of reading j,
///     L_jk = r_jk min(s_j, l_j) min(s_k, l_k)/max(n_j, n_k);
/// s: standard deviation of one simulation at the candidate; l, n: standard deviation of one measurement, widened, and
/// its repeats. If l exceeds s, the rest is measurement error, which is not correlated. An unstated condition adds e_j
/// e_k/12 to L_jk, e: change of a reading over the condition's range; this is the variance of a condition that is
/// uniform on a logarithmic scale. A weight w scales row and column of L by 1/sqrt(w). The log-likelihood is, up to a
/// constant,
///     -(d' C^-1 d + log det L + n/N (log det C - log det L))/2,   n = (tr R)^2/tr(R^2),
/// R: correlation matrix of the N fitted readings over all simulations, n: effective number of independent ones. Two
/// heights and two spreads of one heap are nearly one number: without the factor n/N a candidate of large predictive
/// variance would lose likelihood for each of these readings, and regions without simulations would appear excluded. If
/// one parameter is free and the response jumps, neighbouring simulations replace the models (`SurrogateTrust`).
class ResponseModel {
 public:
  explicit ResponseModel(TrainingData evidence);

  const TrainingData& training_data() const { return evidence_; }
  ReadingModel::Prediction predict(std::size_t reading, const UnitPoint& point) const;
  /// Change of the mean reading between two candidates (`ReadingModel::change`); nothing where the models are not
  /// trusted.
  std::optional<ReadingModel::Prediction> change(std::size_t reading, const UnitPoint& from, const UnitPoint& to) const;
  /// Expected reading: that of the model or, where the model is not trusted, the mean of the candidate's own
  /// simulations, if any.
  double expected(std::size_t reading, const UnitPoint& point) const;
  /// True if `expected` may be reported: the model is trusted at the candidate, or it was simulated.
  bool is_known(const UnitPoint& point) const;
  /// Standard deviation of the reading of one simulation about its mean at this candidate.
  double noise(std::size_t reading, const UnitPoint& point) const;
  /// Indices of the fitted readings.
  const std::vector<std::size_t>& fitted() const { return fitted_; }
  /// C of a candidate. Shape: fitted readings x fitted readings.
  Eigen::MatrixXd covariance(const UnitPoint& point) const;
  /// Distance of a candidate from measurements and priors [1]: root of the sum of squares of the weighted differences
  /// of the mean readings over the standard deviation of one measurement, and of the differences of the coordinates
  /// from their prior means over the prior standard deviations.
  double distance(const UnitPoint& point) const;
  double log_likelihood(const UnitPoint& point) const;
  /// The log-likelihood plus the logarithm of the priors, up to a constant.
  double log_posterior(const UnitPoint& point) const;
  /// Where the models of the fitted readings are trusted.
  const SurrogateTrust& trust() const { return *trust_; }

 private:
  /// Rows of two readings from the same heaps.
  struct Shared {
    std::size_t row_of_first = 0, row_of_second = 0;
    double covariance = 0;  ///< of their noise
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
  Eigen::MatrixXd correlation_;                           // of the readings of one heap
  Eigen::MatrixXd of_conditions_;                         // contribution of unstated conditions to L
  double independent_ = 1;                                // n/N
  std::vector<std::vector<std::vector<Shared>>> shared_;  // each fitted reading with those before it
  std::optional<GaussianProcess> failures_;
  std::optional<Exceedance> rejections_;
  std::optional<SurrogateTrust> trust_;
};

}  // namespace pastefit
