#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "calibrate/search/gaussian_process.h"

namespace pastefit {

/// The simulations' stand-in: answers in microseconds what the residuals of a
/// point are likely to be. The misfit is the expected one, half the sum of
/// squared means and variances, plus the largest misfit seen times the likely
/// share of failures, so that its minimum lies where something is known and
/// little fails. It never fails. Each residual is learnt from the simulations
/// that took its reading; one that none took is expected to be met.
class Surrogate : public Objective {
 public:
  /// `seen`: finished simulations, each on one packing, at least one of them
  /// feasible.
  explicit Surrogate(std::span<const Response> seen);

  int parameters() const override { return parameters_; }
  int residuals() const override { return static_cast<int>(models_.size()); }
  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override;
  int budget_left() const override;
  bool stop_requested() const override { return false; }

  /// Goes on as if `point` had answered on so many packings as it may well do: the mean residuals drawn from what is
  /// known of them, without the noise of the packings; `luck`: standard normal deviates, one for each residual. Returns
  /// them.
  Eigen::VectorXd imagine(const UnitPoint& point, int packings, const Eigen::VectorXd& luck);

  /// Likely misfit of a point and of the noise of one simulation: half the sum
  /// of the noise variances.
  double noise() const;

 private:
  int parameters_ = 0;
  double worst_ = 0;
  std::vector<std::optional<GaussianProcess>> models_;  // one for each residual; none: no simulation took it
  std::unique_ptr<GaussianProcess> failures_;
};

/// The point of least misfit of a model that answers at once: DIRECT_L over the cube, then a local search, both by
/// NLopt.
UnitPoint least_point(Objective& model, const UnitPoint& start);

}  // namespace pastefit
