#include "calibrate/models/replicates.h"

#include <algorithm>
#include <cmath>

namespace pastefit {

Sites sites_of(std::span<const UnitPoint> points) {
  Sites sites;
  for (const UnitPoint& point : points) {
    const auto known = std::ranges::find(sites.points, point);
    sites.of.push_back(static_cast<std::size_t>(known - sites.points.begin()));
    if (known == sites.points.end()) sites.points.push_back(point);
  }
  return sites;
}

namespace {

constexpr double near = 0.1;         // kernel width: root mean square difference of the coordinates
constexpr double harmless_ones = 2;  // assumed simulations with the harmless variance at every point

}  // namespace

ReplicateVariance::ReplicateVariance(std::vector<UnitPoint> points, const Eigen::VectorXd& deviations, double harmless)
    : points_(std::move(points)), harmless_(harmless) {
  for (const double deviation : deviations) squares_.push_back(deviation * deviation);
}

double ReplicateVariance::excess(const UnitPoint& point) const {
  double sum = harmless_ones * harmless_, weights = harmless_ones;
  const double reach = near * near * static_cast<double>(point.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double weight = std::exp(-0.5 * (points_[i] - point).squaredNorm() / reach);
    sum += weight * squares_[i];
    weights += weight;
  }
  return std::max(0.0, sum / weights - harmless_);
}

}  // namespace pastefit
