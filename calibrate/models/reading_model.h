#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "calibrate/models/replicates.h"
#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// One reading as a function of the parameters, learnt from noisy simulations, some of which give only an upper bound:
///     y = b_0 + b.(2x - 1) + f(x) + s(x) e,   log s^2 = g_0 + g_1 u + g_2 (u^2 - 1),
/// a linear trend with wide normal priors, which the model follows far from simulations (generalised least squares); a
/// Gaussian process f with Matérn 5/2 covariance and one length for each coordinate; and standard normal noise e, whose
/// standard deviation s depends on the mean reading: u is that mean in the standardised units of the rows below,
/// clamped to their range. Heaps that keep the mould's shape, or collapse completely, vary little between packings;
/// intermediate slumps vary most. A bound c has the likelihood Phi((c - m)/s), m the mean reading; expectation
/// propagation replaces it by a normal observation that gives m the same first two moments. The lengths, the variance
/// of f and the coefficients g maximise the evidence times broad priors that favour a smooth f and constant noise.
/// Answers at one site are pooled, which is exact and faster. Source: Rasmussen & Williams, Gaussian Processes for
/// Machine Learning (2006), sections 2.2, 2.7, 3.6, 5.4.1. Limit: predictions omit the uncertainty of lengths and
/// variances.
class ReadingModel {
 public:
  struct Answer {
    std::size_t site = 0;
    double value = 0;
    bool is_bound = false;  ///< the true reading is `value` or less
  };
  /// Prediction of the mean reading at a point.
  struct Prediction {
    double mean = 0;
    double variance = 0;      ///< of the mean, without the noise of one simulation
    Eigen::VectorXd weights;  ///< of the rows in the mean
  };
  /// All uncensored answers at one site, or a single bound.
  struct Row {
    std::size_t site = 0;
    bool is_bound = false;
    double noise = 0;  ///< standard deviation of one answer

    // Standardised: less the mean of all rows, over their standard deviation.
    Replicates answers = {};              // or the single bound
    double observed = 0, variance = 1e9;  // of the equivalent normal observation
    double log_weight = 0;                // factor of this observation that gives it the evidence of the bound

    /// Replaces a bound by a normal observation, given mean and variance of the mean reading without the bound.
    void match(double mean, double predictive_variance);
  };

  /// Requirements: the sites are distinct points of the unit cube; there is at least one answer.
  ReadingModel(std::span<const UnitPoint> sites, std::span<const Answer> answers);

  Prediction predict(const UnitPoint& point) const;
  /// Change of the mean reading from one point to another. Its variance is smaller than the sum of the variances of
  /// both means, because errors of neighbouring points are correlated.
  Prediction change(const UnitPoint& from, const UnitPoint& to) const;
  /// Standard deviation of one simulation about its mean, where that mean is `mean`.
  double noise_at(double mean) const;
  const std::vector<Row>& rows() const { return rows_; }
  /// Leave-one-out error of each row (hyper-parameters kept), in the reading's unit; 0 for bounds.
  std::vector<double> leave_one_out() const;

 private:
  /// Hyper-parameters, for standardised readings.
  struct Settings {
    Eigen::VectorXd lengths;
    double signal_variance = 1;
    double noise_level = 0, noise_slope = 0, noise_bend = 0;  // g_0 to g_2
  };

  /// Maximises the evidence from `start`; `with_places`: noise depends on the mean reading.
  void fit(const UnitPoint& start, bool with_places, int evaluations_each);
  UnitPoint point_of(const Settings& settings, bool with_places) const;
  Settings settings_at(const UnitPoint& point, bool with_places) const;
  /// (evidence times priors)^(-2/n), n answers.
  double deviance() const;
  Eigen::Index dimension() const { return sites_.front().size(); }
  void pool(std::span<const Answer> answers);
  void standardise();
  void adopt(const Settings& settings);
  void condition();
  /// One round of expectation propagation over all bounds; returns the largest relative change of an observation.
  double propagate(const Eigen::MatrixXd& prior, const Eigen::LLT<Eigen::MatrixXd>& cholesky);
  double covariance(const UnitPoint& a, const UnitPoint& b) const;
  Eigen::VectorXd covariances(const UnitPoint& point) const;  // with the rows
  /// Posterior of a quantity with mean 0, given its covariances with the rows and its prior variance.
  Prediction conditional(const Eigen::VectorXd& covariances, double variance) const;
  double noise_variance(double mean) const;
  const UnitPoint& place(std::size_t row) const { return sites_[rows_[row].site]; }

  std::vector<UnitPoint> sites_;
  std::vector<Row> rows_;
  double centre_ = 0, scale_ = 0;  // mean and standard deviation of all rows; 0: all are equal
  double lowest_ = 0, highest_ = 0;
  Eigen::VectorXd levels_;  // mean reading of each row, for its noise
  Settings settings_;
  double log_evidence_ = 0;
  Eigen::MatrixXd inverse_;  // of the covariance matrix of the rows, noise included
  Eigen::VectorXd weights_;  // that times the observed values of the rows
};

}  // namespace pastefit
