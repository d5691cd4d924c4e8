#pragma once

#include <optional>
#include <span>
#include <vector>

#include "calibrate/evaluate/objective.h"
#include "calibrate/models/exceedance.h"
#include "calibrate/models/gaussian_process.h"
#include "calibrate/models/replicates.h"

namespace pastefit {

/// Predicts the residuals of a point, and half the sum of their squares, the misfit, in microseconds. The mean of the
/// predicted misfit grows with the predictive variance, with the probability of a failure times the largest misfit
/// seen, and with the disagreement of packings, so that its minimum lies where much is known, little fails, and
/// packings agree. Evaluation cannot fail: nothing is simulated. Each residual is learnt from the simulations that took
/// its reading and that a laboratory would not reject; from all of them, if it would reject every one. A residual that
/// no simulation took is predicted to be zero.
class Surrogate {
 public:
  /// `seen`: finished simulations, each on one packing, at least one of them feasible.
  /// `tolerances`: of each residual, in its own unit. Residuals beyond four tolerances are compressed by a logarithm,
  /// if that makes them likelier (a warped process: Snelson, Rasmussen & Ghahramani 2004): the predicted misfit is then
  /// right near the laboratory and too small far off. Without a tolerance, or with one of 0, a residual is learnt as it
  /// is, and the scatter of its packings is not learnt.
  /// `rejected_share`: largest share of heaps that a laboratory may reject. That share costs as much as one reading
  /// that is off by its tolerance: the misfit grows by t^2 (p/rejected_share)^2/2, p the predicted share, t the root
  /// mean square of the tolerances. 1: rejections do not matter.
  explicit Surrogate(std::span<const Response> seen, const Eigen::VectorXd& tolerances = {}, double rejected_share = 1);

  int residuals() const { return static_cast<int>(models_.size()); }
  /// Predicted means of the residuals of a point, in their own unit or compressed.
  Eigen::VectorXd expected_residuals(const UnitPoint& point) const;

  /// Distribution of the misfit of a point, without the noise of single packings: a part that is certain, plus half the
  /// sum of squared normal variables, approximated by a gamma distribution of the same mean and variance.
  class MisfitPosterior {
   public:
    MisfitPosterior(double certain, double mean, double variance)
        : certain_(certain), mean_(mean), variance_(variance) {}
    double mean() const { return certain_ + mean_; }
    /// Expected improvement on a bound: mean of max(0, bound - misfit).
    double improvement(double bound) const;

   private:
    double certain_, mean_, variance_;
  };
  /// The certain part is the cost of the rejected share, and half the variance of a mean over packings where packings
  /// disagree. The rest includes the cost of failures and a weak normal prior about the middle of the bounds.
  MisfitPosterior misfit_posterior(const UnitPoint& point) const;

  /// For each vector of bounds, the probability that a simulation of the point ends well and the mean of every residual
  /// over packings is within plus or minus its bound. Residuals with a bound of 0 do not count. Shape: a bound for each
  /// residual.
  std::vector<double> within(std::span<const Eigen::VectorXd> bounds, const UnitPoint& point) const;

  /// Conditions on drawn answers of `packings` packings at a point (fantasising): mean residuals from their predictive
  /// distribution, without the noise of the packings; `deviates`: standard normal, one for each residual. Returns the
  /// drawn residuals.
  Eigen::VectorXd fantasise(const UnitPoint& point, int packings, const Eigen::VectorXd& deviates);

  /// Predicted share of heaps that a laboratory would reject, e.g. because they shear off.
  double rejecting(const UnitPoint& point) const;
  /// Probability that it would reject at most `rejected` of `heaps`.
  double accepted(const UnitPoint& point, int rejected, int heaps) const;

  /// Expected misfit that is caused by the noise of one simulation: half the sum of the noise variances.
  double noise() const;

 private:
  void learn_rejections(std::span<const Response> seen, const Eigen::VectorXd& tolerances, double rejected_share);
  void compress_if_likelier(const std::vector<UnitPoint>& points, Eigen::VectorXd& values, double far);
  void learn(const std::vector<UnitPoint>& points, Eigen::VectorXd values, double tolerance);
  /// Variance of a mean over packings, as far as packings disagree by more than what is harmless.
  double variance_of_mean(std::size_t residual, const UnitPoint& point) const;
  /// Predicted probability of a failure.
  double failing(const UnitPoint& point) const;

  double worst_ = 0;
  std::vector<std::optional<GaussianProcess>> models_;  // one for each residual; none: no simulation took it
  std::vector<std::optional<ReplicateVariance>> replicate_variances_;  // likewise; none too without a tolerance
  std::optional<GaussianProcess> failures_;
  std::optional<Exceedance> rejections_;  // none: this kind of test has no rejections, or they do not matter
  double rejected_misfit_ = 0;            // cost of a predicted share of 1
};

/// The point of largest expected improvement on a misfit (Jones, Schonlau & Welch 1998), and that improvement. Failures
/// add the largest misfit seen, in proportion to their probability.
struct Improvement {
  UnitPoint point;
  double expected = 0;
};
Improvement maximise_expected_improvement(const Surrogate& surrogate, double misfit, const UnitPoint& start);

}  // namespace pastefit
