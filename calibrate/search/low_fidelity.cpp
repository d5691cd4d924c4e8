#include "calibrate/search/low_fidelity.h"

#include <algorithm>
#include <cmath>

#include "calibrate/evaluate/response.h"
#include "calibrate/models/exceedance.h"
#include "calibrate/search/surrogate.h"

namespace pastefit {

std::vector<std::uint64_t> packings_of_coarse(std::uint64_t seed, int count) {
  std::vector<std::uint64_t> packings;
  for (int k = 0; k < count; ++k) packings.push_back(coarse_packings + seed * 1000 + static_cast<std::uint64_t>(k));
  return packings;
}

namespace {

/// Coarse grains shear off more often than fine ones: scales their rejection indices by the mean ratio of the roots.
void correct_rejections(std::vector<Response>& coarse, std::span<const Response> fine) {
  const auto root = [](const Response& one) { return Exceedance::root(one.evaluations.front().rejection_index); };
  std::vector<UnitPoint> points;
  std::vector<double> roots;
  for (const Response& one : coarse) {
    if (one.censored || one.evaluations.empty() || std::isnan(one.evaluations.front().rejection_index)) continue;
    points.push_back(one.point);
    roots.push_back(root(one));
  }
  if (points.empty()) return;
  const GaussianProcess of_coarse(points, Eigen::Map<const Eigen::VectorXd>(roots.data(), std::ssize(roots)));
  double of_fine = 0, expected = 0;
  for (const Response& one : fine) {
    if (!is_whole(one) || one.evaluations.empty() || std::isnan(one.evaluations.front().rejection_index)) continue;
    of_fine += root(one);
    expected += of_coarse.predict(one.point).mean;
  }
  if (of_fine <= 0 || expected <= 0) return;
  for (Response& one : coarse)
    if (!one.evaluations.empty()) one.evaluations.front().rejection_index *= std::pow(of_fine / expected, 2);
}

}  // namespace

std::vector<Response> corrected(std::span<const Response> coarse, std::span<const Response> fine) {
  std::vector<Response> moved;
  for (const Response& one : coarse)
    if (is_feasible(one)) moved.push_back(one);
  if (moved.empty()) return moved;
  Surrogate surrogate(moved);
  Eigen::VectorXd bias = Eigen::VectorXd::Zero(moved.front().residuals.size());
  int count = 0;
  for (const Response& one : fine) {
    if (!is_feasible(one)) continue;
    bias += one.residuals - surrogate.expected_residuals(one.point);
    ++count;
  }
  if (count > 0) bias /= count;
  for (Response& one : moved) {
    one.residuals += bias;
    one.misfit = 0.5 * one.residuals.squaredNorm();
  }
  correct_rejections(moved, fine);
  return moved;
}

}  // namespace pastefit
