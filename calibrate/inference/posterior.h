#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "calibrate/search/objective.h"

namespace pastefit {

/// Candidates drawn in proportion to their likelihood over the unit cube:
/// within the bounds of a study every value is as good as any other before the
/// measurement. Method: sequential Monte Carlo. A Sobol sample of the cube is
/// weighted by a growing power of the likelihood, drawn anew when half of its
/// weight is gone, and shaken by random walks as wide as the sample (Del Moral,
/// Doucet & Jasra, J. R. Stat. Soc. B 68 (2006) 411). It finds separate regions
/// and bent valleys, where the linear picture fails. Requirements: dimension >=
/// 1, count >= 2, the logarithm is finite in the cube. Same arguments, same
/// sample.
std::vector<UnitPoint> posterior_sample(const std::function<double(const UnitPoint&)>& log_likelihood, int dimension,
                                        int count, std::uint64_t seed);

/// Of a sample.
struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};
Moments moments_of(const std::vector<UnitPoint>& sample);

}  // namespace pastefit
