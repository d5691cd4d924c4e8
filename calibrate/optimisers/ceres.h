#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// Method for the step within the trust region.
enum class TrustRegion { levenberg_marquardt, dogleg };

/// Trust region of a strategy name; empty for names of other strategies.
std::optional<TrustRegion> trust_region_of(std::string_view strategy);

struct CeresOptions {
  TrustRegion trust_region = TrustRegion::levenberg_marquardt;
  double difference_step = 0.1;  ///< finite difference step in the unit cube; 0 < step <= 0.5; see `noise_step`
  double step_tolerance = 0.01;  ///< shorter steps, in the unit cube, end the run; > 0
  int evaluations = 100;         ///< most points evaluated, start and finite differences included; > 0
  double noise = 0;              ///< an accepted step that improves the value by no more ends the run; >= 0
};

/// Step at which the error of a one-sided difference is least: 2 sqrt(noise/curvature), within [0.01, 0.5]. noise:
/// standard deviation of one residual; curvature: its second derivative in the unit cube; both >= 0. Source: balances 2
/// noise/h against h curvature/2 (Moré & Wild, ACM TOMS 38 (2012) 19).
double noise_step(double noise, double curvature);

/// Minimises half the squared residuals of a problem over the unit cube, from `start`, with a trust region.
/// Requirements: `start` lies in the unit cube, the problem has residuals, the options have values as stated. The
/// Jacobian is by finite differences: all probes of a point are evaluated at once, in parallel, each towards the
/// farther border. A probe that fails is tried on the other side, then on both with a quarter of the step; a column
/// without an answer is zero, so that the parameter is held. A trial point that fails costs twice the worst answer so
/// far, so that Ceres takes a shorter step. A start that fails ends the run at once. Throws what the problem throws,
/// and std::logic_error if a requirement is broken.
Optimum minimise(const Problem& problem, const UnitPoint& start, const CeresOptions& options);

}  // namespace pastefit
