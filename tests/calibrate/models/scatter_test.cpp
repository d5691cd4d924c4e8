#include "calibrate/models/scatter.h"

#include <catch2/catch.hpp>

#include "../search/synthetic.h"
#include "calibrate/base/statistics.h"

using namespace pastefit;
using namespace pastefit::synthetic;

TEST_CASE("packings that scatter more than is harmless are told where they do, and nowhere else") {
  const UnitPoint calm = UnitPoint::Constant(3, 0.2), brittle = UnitPoint::Constant(3, 0.8);
  std::vector<UnitPoint> points;
  Eigen::VectorXd surprises(40);
  for (std::uint64_t k = 0; k < 40; ++k) {
    points.push_back(k % 2 == 0 ? calm : brittle);
    surprises[static_cast<Eigen::Index>(k)] = k % 2 == 0 ? 0.5 * normal(1, k) : (k % 4 == 1 ? 6 : -6);
  }
  const Scatter scatter(points, surprises, 2);
  CHECK(scatter.excess(calm) == 0);
  CHECK(scatter.precision(calm) == 1);
  // Twenty squares of 36 and two of the harmless 2.
  const double there = (20 * 36 + 2 * 2) / 22.0;
  CHECK(scatter.excess(brittle) == Approx(there - 2).epsilon(1e-3));
  CHECK(scatter.precision(brittle) == Approx(2 / there).epsilon(1e-3));
  CHECK(scatter.excess(UnitPoint::Constant(3, 0.5)) < scatter.excess(brittle));
}

TEST_CASE("the usual variance is not moved by a few squares that are none of its kind") {
  std::vector<WeighedSquare> squares;
  for (std::uint64_t k = 0; k < 20'000; ++k) squares.push_back({9 * std::pow(normal(3, k), 2)});
  CHECK(usual_variance(squares) == Approx(9).epsilon(0.04));  // 0.017 is the standard error of such a median
  for (int k = 0; k < 1000; ++k) squares.push_back({1e6});
  CHECK(usual_variance(squares) == Approx(9).epsilon(0.15));
  CHECK(usual_variance({{1, 1}, {4, 5}}) == usual_variance({{4, 1}}));
}
