#pragma once

#include <optional>
#include <span>
#include <vector>

#include "calibrate/search/gaussian_process.h"

namespace pastefit {

/// The simulations' stand-in: answers in microseconds what the residuals of a point are likely to be. The misfit is the
/// mean of its outlook plus the largest misfit seen times the likely share of failures, so that its minimum lies where
/// something is known and little fails. It never fails. Each residual is learnt from the simulations that took its
/// reading; one that none took is expected to be met.
class Surrogate : public Objective {
 public:
  /// `seen`: finished simulations, each on one packing, at least one of them feasible.
  explicit Surrogate(std::span<const Response> seen);

  int parameters() const override { return parameters_; }
  int residuals() const override { return static_cast<int>(models_.size()); }
  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override;
  int budget_left() const override;
  bool stop_requested() const override { return false; }

  /// What the misfit of a point may be, less the noise of the packings: half the sum of squared normal variables, which
  /// is nearly a gamma distribution with the same mean and variance.
  class Outlook {
   public:
    Outlook(double mean, double variance) : mean_(mean), variance_(variance) {}
    double mean() const { return mean_; }
    /// Mean of what lies below this bound: max(0, bound - misfit).
    double improvement(double bound) const;

   private:
    double mean_, variance_;
  };
  /// Its mean includes failures and what a point far from the middle of the bounds has to make up for (a weak prior).
  Outlook outlook(const UnitPoint& point) const;

  /// Probability that a point's residuals, less the noise of the packings, are within these bounds; those with a bound
  /// of 0 do not count. Shape: one for each residual.
  double within(const Eigen::VectorXd& bounds, const UnitPoint& point) const;

  /// Goes on as if `point` had answered on so many packings as it may well do: the mean residuals drawn from what is
  /// known of them, without the noise of the packings; `luck`: standard normal deviates, one for each residual. Returns
  /// them.
  Eigen::VectorXd imagine(const UnitPoint& point, int packings, const Eigen::VectorXd& luck);

  /// Misfit that the noise of one simulation is likely to cause: half the sum of the noise variances.
  double noise() const;

 private:
  double failing(const UnitPoint& point) const;  ///< likely share of failures

  int parameters_ = 0;
  double worst_ = 0;
  std::vector<std::optional<GaussianProcess>> models_;  // one for each residual; none: no simulation took it
  std::optional<GaussianProcess> failures_;
};

/// The point of least misfit of a model that answers at once: DIRECT_L over the cube, then a local search, both by
/// NLopt.
UnitPoint least_point(Objective& model, const UnitPoint& start);

/// The point that is expected to improve most on a misfit (Jones, Schonlau & Welch 1998), failures counted as no
/// improvement, and how much that is.
struct Improvement {
  UnitPoint point;
  double expected = 0;
};
Improvement most_promising(const Surrogate& surrogate, double misfit, const UnitPoint& start);

}  // namespace pastefit
