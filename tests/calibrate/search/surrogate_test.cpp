#include "calibrate/search/surrogate.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "calibrate/search/screening.h"

using namespace pastefit;

namespace {

using Height = double (*)(const UnitPoint&);

/// Sinks the more the weaker it is, and stands above a friction of 0.7, as high as it was filled.
double cliff(const UnitPoint& point) {
  return point[1] > 0.7 ? 210 : 60 * (point[0] - 0.5);
}

/// Sinks the more the weaker it is, over the whole box; bent a little by friction.
double slope(const UnitPoint& point) {
  return 200 * (point[0] - 0.5) + 100 * (point[1] - 0.5) * (point[1] - 0.5);
}

/// The same in two of five heaps; the others have sheared off, and read 80 mm less.
std::vector<Response> heaps_of_which_some_shear() {
  std::vector<Response> heaps;
  for (const UnitPoint& point : screening_points(2, 60, 1)) {
    Response heap;
    heap.point = point;
    heap.rejected = heaps.size() % 5 < 3 ? 1 : 0;
    heap.evaluations.resize(1);
    heap.evaluations[0].rejection_index = heap.rejected > 0 ? 1.3 : 0.6;
    heap.residuals = Eigen::VectorXd::Constant(1, slope(point) - 80 * heap.rejected);
    heap.misfit = 0.5 * heap.residuals.squaredNorm();
    heaps.push_back(heap);
  }
  return heaps;
}

/// Root mean square error of a surrogate of 40 heaps where they are within twice the tolerance of 7.5.
double error_near_the_laboratory(Height height, const Eigen::VectorXd& tolerances) {
  std::vector<Response> heaps;
  for (const UnitPoint& point : screening_points(2, 40, 1)) {
    Response heap;
    heap.point = point;
    heap.residuals = Eigen::VectorXd::Constant(1, height(point));
    heap.misfit = 0.5 * heap.residuals.squaredNorm();
    heaps.push_back(heap);
  }
  Surrogate surrogate(heaps, tolerances);
  double squares = 0;
  int count = 0;
  for (const UnitPoint& point : screening_points(2, 200, 2)) {
    if (std::abs(height(point)) > 15) continue;
    squares += std::pow(surrogate.expected_residuals(point)[0] - height(point), 2);
    ++count;
  }
  return std::sqrt(squares / count);
}

const Eigen::VectorXd tolerance = Eigen::VectorXd::Constant(1, 7.5);

}  // namespace

TEST_CASE("a heap that stands does not blur what is learnt of those near the laboratory's") {
  const double with = error_near_the_laboratory(cliff, tolerance), without = error_near_the_laboratory(cliff, {});
  INFO(with << " mm, " << without << " mm where every residual is learnt as it is");
  CHECK(with < 0.6 * without);
}

TEST_CASE("a height that changes evenly over the whole box is learnt as it is") {
  const double with = error_near_the_laboratory(slope, tolerance), without = error_near_the_laboratory(slope, {});
  INFO(with << " mm, " << without << " mm where every residual is learnt as it is");
  CHECK(with <= 1.05 * without);
}

TEST_CASE("what is learnt of a reading is that of the heaps that stand, and how many shear is learnt beside it") {
  const Surrogate surrogate(heaps_of_which_some_shear(), tolerance, 0.2);
  for (const UnitPoint& point : screening_points(2, 50, 2)) {
    CHECK(surrogate.rejecting(point) > 0.3);
    if (std::abs(slope(point)) > 15) continue;
    CHECK(surrogate.expected_residuals(point)[0] == Approx(slope(point)).margin(5));
  }
}
