#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "calibrate/models/replicates.h"
#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// One reading as a function of the parameters, learnt from noisy simulations, some of which say only that they read
/// so or less:
///     y = b_0 + b.(2x - 1) + f(x) + s(x) e,   log s^2 = g_0 + g_1 u + g_2 (u^2 - 1),
/// a trend with wide normal priors, so that it is followed where there are no simulations (generalised least squares);
/// a Gaussian process f with a Matérn 5/2 covariance and one length for each coordinate; standard normal noise e whose
/// deviation depends on the mean reading itself, u, in standard deviations of all sites from their mean: heaps that
/// stand or have flowed away scatter less than those between. A bound c has the likelihood Phi((c - mean)/s);
/// expectation propagation replaces it by the normal observation of the same effect. Lengths, variance of f and g
/// maximise the evidence times broad priors that favour a smooth f and even noise. Answers of one site are pooled,
/// which changes nothing but the time it takes. Source: Rasmussen & Williams, Gaussian Processes for Machine Learning
/// (2006), sections 2.2, 2.7, 3.6, 5.4.1. Limit: the predictive_variance of lengths and variances themselves is not
/// counted.
class ReadingModel {
 public:
  /// What one simulation answered.
  struct Answer {
    std::size_t site = 0;
    double value = 0;
    bool is_bound = false;  ///< it read so or less
  };
  /// What is known of a candidate.
  struct Prediction {
    double mean = 0;
    double variance = 0;      ///< of the mean, without the noise of one simulation
    Eigen::VectorXd weights;  ///< of the rows in that mean
  };
  /// The answers of one site that are no bounds, or one bound.
  struct Row {
    std::size_t site = 0;
    bool is_bound = false;
    double noise = 0;  ///< standard deviation of one answer

    // In standard deviations of all sites, from their mean.
    Replicates answers = {};              // or the bound alone
    double observed = 0, variance = 1e9;  // the same as one normal observation
    double log_weight = 0;                // of that one, so that it has the bound's evidence

    void match(double mean, double predictive_variance);
  };

  /// Requirements: sites are points of the unit cube, each once; there is an answer.
  ReadingModel(std::span<const UnitPoint> sites, std::span<const Answer> answers);

  Prediction predict(const UnitPoint& point) const;
  /// Standard deviation of one simulation about its mean, where the mean is this.
  double noise_at(double mean) const;
  const std::vector<Row>& rows() const { return rows_; }

 private:
  /// All but the answers, in the same unit.
  struct Settings {
    Eigen::VectorXd lengths;
    double signal_variance = 1;
    double noise_level = 0, noise_slope = 0, noise_bend = 0;  // g_0 to g_2
  };

  /// The settings of most evidence from `start` on; `with_places`: the noise may depend on the mean reading.
  void fit(const UnitPoint& start, bool with_places, int evaluations_each);
  UnitPoint point_of(const Settings& settings, bool with_places) const;
  Settings settings_at(const UnitPoint& point, bool with_places) const;
  /// The evidence times the priors, to the power -2/n.
  double deviance() const;
  Eigen::Index dimension() const { return sites_.front().size(); }
  void pool(std::span<const Answer> answers);
  void standardise();
  void adopt(const Settings& settings);
  void condition();
  /// One round of expectation propagation over all bounds; answers how much it has changed.
  double propagate(const Eigen::MatrixXd& prior, const Eigen::LLT<Eigen::MatrixXd>& cholesky);
  double covariance(const UnitPoint& a, const UnitPoint& b) const;
  double noise_variance(double mean) const;
  const UnitPoint& place(std::size_t row) const { return sites_[rows_[row].site]; }

  std::vector<UnitPoint> sites_;
  std::vector<Row> rows_;
  double centre_ = 0, scale_ = 0;  // mean and deviation of all sites; 0: all are the same
  double lowest_ = 0, highest_ = 0;
  Eigen::VectorXd levels_;  // mean reading of each row, by which its noise is chosen
  Settings settings_;
  double log_evidence_ = 0;
  Eigen::MatrixXd inverse_;  // of the covariance of the rows, noise included
  Eigen::VectorXd weights_;  // that times the rows' values
};

}  // namespace pastefit
