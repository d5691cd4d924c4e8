#include "calibrate/models/gaussian_process.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "../search/synthetic.h"
#include "calibrate/search/screening.h"

using namespace pastefit;

namespace {

/// 24 noisy answers of a smooth function at 12 points, two at each.
struct NoisyAnswers {
  std::vector<UnitPoint> points;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(24);

  NoisyAnswers() {
    for (const UnitPoint& point : screening_points(2, 12, 3))
      for (int repeat = 0; repeat < 2; ++repeat) points.push_back(point);
    for (Eigen::Index i = 0; i < 24; ++i) {
      const UnitPoint& point = points[static_cast<std::size_t>(i)];
      values[i] = std::sin(4 * point[0]) + point[1] * point[1] + 0.05 * synthetic::normal(7, i);
    }
  }
};

}  // namespace

TEST_CASE("the Matern correlation has the values of an independent implementation") {
  // (1 + r + r^2/3) exp(-r), r = sqrt(5) d, in decimal arithmetic of 30 digits (the decimal module of Python).
  const Eigen::Vector2d lengths(0.5, 2);
  const auto at = [&](double x, double y) {
    return matern_covariance(Eigen::Vector2d(0, 0), Eigen::Vector2d(x, y), lengths);
  };
  CHECK(at(0, 0) == 1);
  CHECK(at(0.5, 0) == Approx(0.523994108831820).epsilon(1e-12));
  CHECK(at(0, 2) == Approx(0.523994108831820).epsilon(1e-12));
  CHECK(at(1, 0) == Approx(0.138660219138504).epsilon(1e-12));
}

TEST_CASE("predictions are those of the textbook's formula, without pooling") {
  const NoisyAnswers seen;
  const GaussianProcess process(seen.points, seen.values);
  const Eigen::Index n = seen.values.size();
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      covariance(i, j) =
          process.signal_variance() * matern_covariance(seen.points[static_cast<std::size_t>(i)],
                                                        seen.points[static_cast<std::size_t>(j)], process.lengths());
  covariance.diagonal().array() += process.noise_variance();
  const Eigen::MatrixXd inverse = covariance.inverse();
  const double mean = (inverse * seen.values).sum() / inverse.sum();  // generalised least squares
  for (const UnitPoint& point : screening_points(2, 20, 9)) {
    Eigen::VectorXd with(n);
    for (Eigen::Index i = 0; i < n; ++i)
      with[i] = process.signal_variance() *
                matern_covariance(point, seen.points[static_cast<std::size_t>(i)], process.lengths());
    const auto prediction = process.predict(point);
    CHECK(prediction.mean == Approx(mean + with.dot(inverse * (seen.values.array() - mean).matrix())).epsilon(1e-8));
    CHECK(prediction.variance ==
          Approx(process.signal_variance() - with.dot(inverse * with)).epsilon(1e-6).margin(1e-9));
  }
}

TEST_CASE("the noise is learnt from repeats, and the function between the points") {
  const NoisyAnswers seen;
  const GaussianProcess process(seen.points, seen.values);
  CHECK(std::sqrt(process.noise_variance()) == Approx(0.05).epsilon(0.6));
  double squares = 0;
  const auto points = screening_points(2, 50, 9);
  for (const UnitPoint& point : points)
    squares += std::pow(process.predict(point).mean - std::sin(4 * point[0]) - point[1] * point[1], 2);
  CHECK(std::sqrt(squares / 50) < 0.15);
}

TEST_CASE("a fantasised answer draws the mean to it and takes the uncertainty away, as a true one would") {
  const NoisyAnswers seen;
  GaussianProcess process(seen.points, seen.values);
  const Eigen::Vector2d point(0.9, 0.95);
  const auto before = process.predict(point);
  process.fantasise(point, before.mean + 1, 100);
  CHECK(process.predict(point).mean > before.mean + 0.5);
  CHECK(process.predict(point).variance < 0.5 * before.variance);
}

TEST_CASE("answers that are all the same are predicted everywhere, without uncertainty") {
  const NoisyAnswers seen;
  const GaussianProcess process(seen.points, Eigen::VectorXd::Constant(24, 3));
  CHECK(process.predict(Eigen::Vector2d(0.1, 0.7)).mean == 3);
  CHECK(process.predict(Eigen::Vector2d(0.1, 0.7)).variance == 0);
}
