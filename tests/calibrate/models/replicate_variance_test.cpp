#include <catch2/catch.hpp>

#include "../search/synthetic.h"
#include "calibrate/base/statistics.h"
#include "calibrate/models/replicates.h"

using namespace pastefit;
using namespace pastefit::synthetic;

TEST_CASE("packings that scatter more than is harmless are told where they do, and nowhere else") {
  const UnitPoint calm = UnitPoint::Constant(3, 0.2), brittle = UnitPoint::Constant(3, 0.8);
  std::vector<UnitPoint> points;
  Eigen::VectorXd deviations(40);
  for (std::uint64_t k = 0; k < 40; ++k) {
    points.push_back(k % 2 == 0 ? calm : brittle);
    deviations[static_cast<Eigen::Index>(k)] = k % 2 == 0 ? 0.5 * normal(1, k) : (k % 4 == 1 ? 6 : -6);
  }
  const ReplicateVariance variance(points, deviations, 2);
  CHECK(variance.excess(calm) == 0);
  CHECK(variance.precision(calm) == 1);
  // Twenty squares of 36 and two of the harmless 2.
  const double there = (20 * 36 + 2 * 2) / 22.0;
  CHECK(variance.excess(brittle) == Approx(there - 2).epsilon(1e-3));
  CHECK(variance.precision(brittle) == Approx(2 / there).epsilon(1e-3));
  CHECK(variance.excess(UnitPoint::Constant(3, 0.5)) < variance.excess(brittle));
}

TEST_CASE("the typical variance is not moved by a few squares that are none of its kind") {
  std::vector<WeighedSquare> squares;
  for (std::uint64_t k = 0; k < 20'000; ++k) squares.push_back({9 * std::pow(normal(3, k), 2)});
  CHECK(typical_variance(squares) == Approx(9).epsilon(0.04));  // 0.017 is the standard error of such a median
  for (int k = 0; k < 1000; ++k) squares.push_back({1e6});
  CHECK(typical_variance(squares) == Approx(9).epsilon(0.15));
  CHECK(typical_variance({{1, 1}, {4, 5}}) == typical_variance({{4, 1}}));
}
