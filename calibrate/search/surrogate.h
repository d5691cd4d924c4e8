#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/models/gaussian_process.h"
#include "calibrate/models/replicates.h"

namespace pastefit {

/// Predicts the residuals of a point and their misfit, in microseconds. Evaluation cannot fail: nothing is simulated.
/// The mean of the predicted misfit increases with the predictive variance, with the probability of a failure times the
/// largest misfit observed, and with the scatter between packings. Each residual is trained on the simulations with its
/// reading that are not rejected; on all of them if all are rejected. A residual without any simulation is predicted to
/// be zero.
class Surrogate {
 public:
  /// `seen`: finished simulations on one packing each, at least one of them feasible. `tolerances`: of each residual,
  /// in its own unit. Residuals beyond four tolerances are compressed logarithmically if that increases the likelihood
  /// (a warped process: Snelson, Rasmussen & Ghahramani 2004): the predicted misfit is then accurate near the
  /// measurement and too small far from it. If empty or 0, the residual is not compressed and the scatter of its
  /// packings not modelled. `rejected_share`: largest accepted share c of rejected heaps. A predicted share p adds t^2
  /// (p/c)^2/2 to the misfit, t the root mean square of the tolerances: p = c costs as much as one reading off by its
  /// tolerance. 1: no cost.
  explicit Surrogate(std::span<const Response> seen, const Eigen::VectorXd& tolerances = {}, double rejected_share = 1);

  int residuals() const { return static_cast<int>(models_.size()); }
  /// Predicted means of the residuals, in their own unit or compressed.
  Eigen::VectorXd expected_residuals(const UnitPoint& point) const;

  /// Distribution of the misfit of a point, without the noise of single packings: a fixed part plus half the sum of
  /// squared normal variables, approximated by a gamma distribution with the same mean and variance.
  struct MisfitPosterior {
    double fixed, uncertain_mean, variance;
    double mean() const { return fixed + uncertain_mean; }
    /// Expected improvement on a bound: mean of max(0, bound - misfit).
    double improvement(double bound) const;
  };
  /// The fixed part is the cost of the rejected share plus half the excess variance of a mean over packings. The rest
  /// includes the cost of failures and a weak normal prior about the middle of the bounds.
  MisfitPosterior misfit_posterior(const UnitPoint& point) const;

  /// For each vector of bounds, the probability that a simulation does not fail and every residual, as mean over
  /// packings, is within plus or minus its bound. A bound of 0 means no bound. Shape: one bound for each residual.
  std::vector<double> within(std::span<const Eigen::VectorXd> bounds, const UnitPoint& point) const;

  /// Conditions on a fantasised answer at a point: mean residuals drawn from their predictive distribution, without
  /// replicate scatter. `deviates`: standard normal, one for each residual.
  void fantasise(const UnitPoint& point, const Eigen::VectorXd& deviates);

  /// Predicted share of rejected heaps, e.g. sheared off.
  double rejecting(const UnitPoint& point) const;
  /// Probability that at most `rejected` of `heaps` are rejected.
  double accepted(const UnitPoint& point, int rejected, int heaps) const;

  /// Expected misfit due to the noise of one simulation: half the sum of the noise variances.
  double noise() const;

 private:
  void learn_rejections(std::span<const Response> seen, const Eigen::VectorXd& tolerances, double rejected_share);
  void compress_if_likelier(const std::vector<UnitPoint>& points, Eigen::VectorXd& values, double far);
  void learn(const std::vector<UnitPoint>& points, Eigen::VectorXd values, double tolerance);
  /// Excess of the variance of a mean over packings above the harmless variance.
  double variance_of_mean(std::size_t residual, const UnitPoint& point) const;
  /// Predicted probability of a failure.
  double failing(const UnitPoint& point) const;

  double worst_ = 0;
  std::vector<std::optional<GaussianProcess>> models_;                 // of each residual; none: no data
  std::vector<std::optional<ReplicateVariance>> replicate_variances_;  // likewise; none without a tolerance
  std::optional<GaussianProcess> failures_;
  std::optional<Exceedance> rejections_;  // none: test without rejections, or no cost
  double rejected_misfit_ = 0;            // cost of a predicted share of 1
};

/// Point of largest expected improvement on a misfit (Jones, Schonlau & Welch 1998), and that improvement. A failure
/// costs the largest misfit observed, times its probability.
struct Improvement {
  UnitPoint point;
  double expected = 0;
};
Improvement maximise_expected_improvement(const Surrogate& surrogate, double misfit, const UnitPoint& start);

// Coarse grains, which are cheaper to simulate.

/// First packing seed of coarse grains; distinct from the study's, so that both can share one store.
inline constexpr std::uint64_t coarse_packings = 1ULL << 40;

/// Packings of coarse grains, the same for every candidate.
std::vector<std::uint64_t> packings_of_coarse(std::uint64_t seed, int count);

/// Coarse simulations as predictions of fine ones: the feasible ones with their residuals shifted by
///     bias = mean over the feasible fine simulations of (their residuals - coarse surrogate at their point),
/// one for each reading; 0 without fine simulations. Requirements: `coarse` and `fine` are on one packing each, with
/// equally weighted residuals. Because the search simulates every candidate with coarse grains first, the surrogate has
/// data at the fine points. Limit: all candidates get the same bias, that near the target, where the fine simulations
/// concentrate.
std::vector<Response> corrected(std::span<const Response> coarse, std::span<const Response> fine);

}  // namespace pastefit
