#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "calibrate/batch/interpolation.h"

namespace pastefit {
namespace {

TEST_CASE("a line through points on it predicts without an interval") {
  const std::vector<double> x{1, 2, 4, 7}, y{5, 7, 11, 17};
  const TrendPrediction at_three = predict_trend(x, y, 3, TrendModel::linear);
  CHECK(at_three.mean == Approx(9));
  CHECK(at_three.half_width == Approx(0).margin(1e-9));
}

TEST_CASE("the interval of a line is Student's prediction interval") {
  // Of x = 1..5, y = 2, 4, 5, 4, 5: slope 0.6, s^2 = 0.8, t(0.975; 3) = 3.1824.
  const std::vector<double> x{1, 2, 3, 4, 5}, y{2, 4, 5, 4, 5};
  const TrendPrediction at_four = predict_trend(x, y, 4, TrendModel::linear);
  CHECK(at_four.mean == Approx(4.6));
  CHECK(at_four.half_width == Approx(3.1824 * std::sqrt(0.8 * (1 + 0.2 + 0.1))).epsilon(1e-3));
}

TEST_CASE("a Gaussian process follows a bend that a line misses") {
  std::vector<double> x, y;
  for (int i = 0; i <= 10; ++i) {
    x.push_back(150 + 10 * i);
    y.push_back(std::pow(0.1 * i - 0.5, 2));
  }
  const TrendPrediction middle = predict_trend(x, y, 205, TrendModel::gaussian_process);
  CHECK(middle.mean == Approx(0.0025).margin(0.02));
  CHECK(middle.half_width < 0.1);
  CHECK(predict_trend(x, y, 205, TrendModel::linear).mean > 0.05);
}

}  // namespace
}  // namespace pastefit
