#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/optimisers/problem.h"
#include "core/result.h"

namespace pastefit {

/// How NLopt should search.
struct NloptOptions {
  std::string algorithm = "bobyqa";  ///< one of `nlopt_algorithm_names()`
  int evaluations = 100;             ///< most points asked, the start included; > 0
  double initial_step = 0.2;         ///< first step of the local algorithms, in the unit cube; 0 < step <= 0.5
  double step_tolerance = 1e-3;      ///< steps shorter than this, in the unit cube, end the run; > 0
  double noise = 0;                  ///< improvements of the value up to it do not count; >= 0
  int patience = 0;                  ///< points without an improvement beyond `noise` that end the run; 0: no end
  std::uint64_t seed = 1;            ///< of the algorithms that draw random numbers
};

/// Names of the algorithms, in a fixed order: those of NLopt's that a user would choose when a question costs a
/// simulation, two global ones and four local ones.
std::vector<std::string_view> nlopt_algorithm_names();

/// Everything wrong with the options; empty: fit to run.
Faults validate(const NloptOptions& options);

/// Minimises a problem over the unit cube, from `start`.
/// Requirements: `validate(options)` is empty, `start` lies in the unit cube.
/// NLopt never sees the value f itself but f/(f + f_start), between 0 and 1, and 1 to 2 for a failure: finite,
/// bounded, in the same order as the value and the same from the first call to the last, so that a failure is worse
/// than any answer without a cliff that grows with the units. Points outside the cube are moved to its border, points
/// that are not a number are never asked. The best answer is kept here, never taken from NLopt.
/// A claim of convergence is checked by asking the neighbours of the best point, a quarter of `initial_step` away.
/// Limits: an algorithm that loops without asking for a point cannot be ended from within; none was found to do so
/// as long as it is answered with bounded numbers.
/// Errors: in the status. Throws what the problem throws, and std::logic_error if a requirement is broken.
Optimum minimise(const Problem& problem, const UnitPoint& start, const NloptOptions& options);

/// The least point of a function that answers at once: DIRECT_L over the cube, then BOBYQA from there.
UnitPoint least_point(const std::function<double(const UnitPoint&)>& function, const UnitPoint& start);

}  // namespace pastefit
