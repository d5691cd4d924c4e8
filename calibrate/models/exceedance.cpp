#include "calibrate/models/exceedance.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <vector>

namespace pastefit {
namespace {

// Least standard deviation of the root: values that lie on a smooth curve by chance do not make the next one certain.
constexpr double least_scatter = 0.02;

// Medians of the five equally likely parts of a standard normal variable, scaled to variance 1.
constexpr std::array fifths{-1.4634, -0.5988, 0.0, 0.5988, 1.4634};

Eigen::VectorXd roots(std::span<const double> values) {
  Eigen::VectorXd out(std::ssize(values));
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = Exceedance::root(values[i]);
  return out;
}

double scatter_of(const GaussianProcess& process) {
  return std::max(process.noise_variance(), least_scatter * least_scatter);
}

double normal_cdf(double deviate) {
  return 0.5 * std::erfc(-deviate / std::sqrt(2.0));
}

}  // namespace

Exceedance::Exceedance(std::span<const UnitPoint> points, std::span<const double> values)
    : roots_(points, roots(values)) {}

double Exceedance::probability(const UnitPoint& point) const {
  const GaussianProcess::Prediction mean = roots_.predict(point);
  return normal_cdf((mean.mean - 1) / std::sqrt(scatter_of(roots_) + mean.variance));
}

double Exceedance::probability_of_at_most(int exceeding, int count, const UnitPoint& point) const {
  const GaussianProcess::Prediction mean = roots_.predict(point);
  const double deviation = std::sqrt(mean.variance), scatter = std::sqrt(scatter_of(roots_));
  double sum = 0;
  for (const double deviate : fifths) {
    const double share = normal_cdf((mean.mean + deviate * deviation - 1) / scatter);
    sum += boost::math::cdf(boost::math::binomial_distribution<>(count, share), exceeding);
  }
  return sum / static_cast<double>(fifths.size());
}

}  // namespace pastefit
