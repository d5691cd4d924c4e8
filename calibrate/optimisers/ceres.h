#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "calibrate/optimisers/problem.h"
#include "core/result.h"

namespace pastefit {

/// How Ceres chooses a step within the trust region.
enum class TrustRegion { levenberg_marquardt, dogleg };

/// The strategies that Ceres carries out, by name; empty for any other name.
std::optional<TrustRegion> trust_region_of(std::string_view strategy);

/// What a residual costs; all but `none` keep one bad measurement from ruling the fit.
enum class Loss { none, huber, cauchy };

/// How Ceres should search.
struct CeresOptions {
  TrustRegion trust_region = TrustRegion::levenberg_marquardt;
  Loss loss = Loss::none;
  double loss_scale = 1;         ///< size of a residual at which its loss bends; > 0
  double difference_step = 0.1;  ///< probe for the Jacobian, in the unit cube; 0 < step <= 0.5; see `noise_step`
  double step_tolerance = 0.01;  ///< steps shorter than this, in the unit cube, end the run; > 0
  int evaluations = 100;         ///< most points asked, the start and the probes included; > 0
  double noise = 0;              ///< an accepted step that improves the value by no more ends the run; >= 0
};

/// The probe at which the error of a one-sided difference is least: 2 sqrt(noise/curvature), within [0.01, 0.5].
/// noise: standard deviation of one residual; curvature: its second derivative in the unit cube; both >= 0.
/// Source: balances 2 noise/h against h curvature/2 (Moré & Wild, ACM TOMS 38 (2012) 19).
double noise_step(double noise, double curvature);

/// Everything wrong with the options; empty: fit to run.
Faults validate(const CeresOptions& options);

/// Minimises half the squared residuals of a problem over the unit cube, from `start`, by a trust region.
/// Requirements: `validate(options)` is empty, `start` lies in the unit cube, the problem has residuals.
/// The Jacobian is by differences: all probes of a point are asked at once, so that they run in parallel, each towards
/// the farther border. A probe that fails is tried on the other side, then on both with a quarter of the step; a
/// column without an answer is zero and mentioned in the reason. A trial point that fails costs twice the worst answer
/// so far, so that Ceres takes a shorter step. A start that fails ends the run at once.
/// The best is the feasible answer of least cost: the value, or half the sum of the losses if there is a loss.
/// Errors: in the status. Throws what the problem throws, and std::logic_error if a requirement is broken.
Optimum minimise(const Problem& problem, const UnitPoint& start, const CeresOptions& options);

}  // namespace pastefit
