#pragma once

#include <optional>
#include <span>
#include <vector>

#include "calibrate/models/exceedance.h"
#include "calibrate/models/gaussian_process.h"
#include "calibrate/models/replicate_variance.h"
#include "calibrate/search/objective.h"

namespace pastefit {

/// The simulations' stand-in: answers in microseconds what the residuals of a point are likely to be. The misfit is the
/// mean of its misfit_posterior plus the largest misfit seen times the likely share of failures, so that its minimum
/// lies where something is known, little fails, and packings agree. It never fails. Each residual is learnt from the
/// simulations that took its reading and that a laboratory would not reject; from all, where it would reject every one.
/// A residual that none took is expected to be met.
class Surrogate {
 public:
  /// `seen`: finished simulations, each on one packing, at least one of them feasible. `tolerances`: of each residual,
  /// in its own unit; of a residual beyond four of them the logarithm is learnt and answered if it is likelier
  /// (a warped process: Snelson, Rasmussen & Ghahramani 2004), so that a misfit is true near the laboratory and may be
  /// too small far off. One of 0, or that is not given, is learnt as it is and may scatter as it likes.
  /// `rejected_share`: of heaps that a laboratory may reject, at most. So large a share is as bad as a reading that is
  /// off by its tolerance: half the square of the likely share over this one, in squares of the mean tolerance, adds to
  /// the misfit. 1: it does not matter.
  explicit Surrogate(std::span<const Response> seen, const Eigen::VectorXd& tolerances = {}, double rejected_share = 1);

  int residuals() const { return static_cast<int>(models_.size()); }
  /// What the residuals of a point are expected to be, in their own unit or compressed.
  Eigen::VectorXd expected_residuals(const UnitPoint& point) const;

  /// What the misfit of a point may be, less the typical noise of the packings: a part that is certain, and half the
  /// sum of squared normal variables, which is nearly a gamma distribution with the same mean and variance.
  class MisfitPosterior {
   public:
    MisfitPosterior(double certain, double mean, double variance)
        : certain_(certain), mean_(mean), variance_(variance) {}
    double mean() const { return certain_ + mean_; }
    /// Mean of what lies below this bound: max(0, bound - misfit).
    double improvement(double bound) const;

   private:
    double certain_, mean_, variance_;
  };
  /// Certain is what a mean over some packings is off by where they variance. Its mean includes failures and what a
  /// point far from the middle of the bounds has to make up for (a weak prior).
  MisfitPosterior misfit_posterior(const UnitPoint& point) const;

  /// Probability that a point's residuals, less the noise of the packings, are within bounds, for each of some bounds;
  /// residuals with a bound of 0 do not count. Shape: a bound for each residual.
  std::vector<double> within(std::span<const Eigen::VectorXd> bounds, const UnitPoint& point) const;

  /// Conditions on `point` as if it had answered on so many packings as it may well do (fantasising): the mean
  /// residuals drawn from what is known of them, without the noise of the packings; `deviates`: standard normal ones,
  /// one for each residual. Returns them.
  Eigen::VectorXd fantasise(const UnitPoint& point, int packings, const Eigen::VectorXd& deviates);

  /// Likely share of heaps that a laboratory would reject, e.g. that shear off.
  double rejecting(const UnitPoint& point) const;
  /// Probability that it would reject at most so many of some heaps.
  double accepted(const UnitPoint& point, int rejected, int heaps) const;

  /// Misfit that the noise of one simulation is likely to cause: half the sum of the noise variances.
  double noise() const;

 private:
  void learn_rejections(std::span<const Response> seen, const Eigen::VectorXd& tolerances, double rejected_share);
  void compress_if_likelier(const std::vector<UnitPoint>& points, Eigen::VectorXd& values, double far);
  void learn(const std::vector<UnitPoint>& points, Eigen::VectorXd values, double tolerance);
  /// Variance of the mean of some packings beyond what does no harm.
  double variance_of_mean(std::size_t residual, const UnitPoint& point) const;
  /// Likely share of failures.
  double failing(const UnitPoint& point) const;

  double worst_ = 0;
  std::vector<std::optional<GaussianProcess>> models_;  // one for each residual; none: no simulation took it
  std::vector<std::optional<ReplicateVariance>> replicate_variances_;  // likewise; none too where it does not matter
  std::optional<GaussianProcess> failures_;
  std::optional<Exceedance> rejections_;  // none: no kind of test of which runs are rejected, or it does not matter
  double rejected_misfit_ = 0;            // of a share of 1
};

/// The point that is expected to improve most on a misfit (Jones, Schonlau & Welch 1998), failures counted as no
/// improvement, and how much that is.
struct Improvement {
  UnitPoint point;
  double expected = 0;
};
Improvement maximise_expected_improvement(const Surrogate& surrogate, double misfit, const UnitPoint& start);

}  // namespace pastefit
