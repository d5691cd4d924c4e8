#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

struct NloptOptions {
  std::string algorithm = "bobyqa";  ///< one of `nlopt_algorithm_names()`
  int evaluations = 100;             ///< most points evaluated, start included; > 0
  double initial_step = 0.2;         ///< first step of the local algorithms, in the unit cube; 0 < step <= 0.5
  double step_tolerance = 1e-3;      ///< shorter steps, in the unit cube, end the run; > 0
  std::uint64_t seed = 1;            ///< of randomised algorithms
};

/// Names of the algorithms, in a fixed order: two global and four local ones of NLopt's that suit expensive functions.
std::vector<std::string_view> nlopt_algorithm_names();

/// Minimises a problem over the unit cube, from `start`. Requirements: the algorithm is known, `start` lies in the
/// unit cube. NLopt gets f/(f + f_start) instead of the value f, between 0 and 1, and 1 to 2 for a failure. This is
/// bounded, keeps the order and does not change during the run, so that a failure is worse than any answer without a
/// cliff that depends on the units. Points outside the cube are moved to its border; points that are not numbers are
/// not evaluated. The best answer is recorded here, not taken from NLopt. After a claim of convergence the
/// neighbours of the best point, a quarter of `initial_step` away, are evaluated as well. Limit: an algorithm that
/// loops without evaluating a point cannot be stopped; none is known to do so for bounded values. Throws what the
/// problem throws, and std::logic_error if a requirement is broken.
Optimum minimise(const Problem& problem, const UnitPoint& start, const NloptOptions& options);

/// Minimiser of a cheap function: DIRECT_L over the cube, then BOBYQA from there.
UnitPoint least_point(const std::function<double(const UnitPoint&)>& function, const UnitPoint& start);

}  // namespace pastefit
