#include <boost/math/distributions/binomial.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "../search/synthetic.h"
#include "calibrate/models/gaussian_process.h"

using namespace pastefit;

namespace {

constexpr double scatter = 0.25;

/// The root of the mean value grows from left to right.
double mean_root(const UnitPoint& point) {
  return 0.3 + 1.2 * point[0];
}

double truth(const UnitPoint& point) {
  return 0.5 * std::erfc((1 - mean_root(point)) / scatter / std::sqrt(2.0));
}

double value_at(const UnitPoint& point, std::uint64_t seed, std::uint64_t counter) {
  return std::pow(std::max(0.0, mean_root(point) + scatter * synthetic::normal(seed, counter)), 2);
}

Exceedance learnt_from(const std::vector<UnitPoint>& points, std::uint64_t seed) {
  std::vector<double> values;
  for (std::size_t i = 0; i < points.size(); ++i) values.push_back(value_at(points[i], seed, i));
  return Exceedance(points, values);
}

/// Root mean square error of the probability, of ten samples of so many values in three dimensions.
double error_of(int count) {
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Exceedance exceedance = learnt_from(screening_points(3, count, seed), seed);
    for (const UnitPoint& point : screening_points(3, 50, seed + 100))
      squares += std::pow(exceedance.probability(point) - truth(point), 2) / 500;
  }
  return std::sqrt(squares);
}

}  // namespace

TEST_CASE("the probability of an exceedance is learnt from values, of which few exceed the limit") {
  double of_even_odds = 0;
  for (const UnitPoint& point : screening_points(3, 500, 7)) of_even_odds += std::pow(truth(point) - 0.5, 2) / 500;
  CHECK(error_of(60) < 0.3 * std::sqrt(of_even_odds));
}

TEST_CASE(
    "where all is known, at most so many exceed as the binomial distribution says; where little is, it is less sure") {
  const UnitPoint point = UnitPoint::Constant(2, 0.3);
  const double share = truth(point);
  const auto chance = [&](std::size_t answers) {
    return learnt_from(std::vector<UnitPoint>(answers, point), 3).probability_of_at_most(1, 16, point);
  };
  const double known = boost::math::cdf(boost::math::binomial_distribution<>(16, share), 1);
  CHECK(chance(1000) == Approx(known).margin(0.06));
  CHECK(chance(4) < known);
}

TEST_CASE("what comes nowhere near its limit is not expected to exceed it") {
  const std::vector<UnitPoint> points = screening_points(4, 30, 5);
  const Exceedance never(points, std::vector<double>(30, 0.04));
  for (const UnitPoint& point : screening_points(4, 20, 6)) CHECK(never.probability(point) < 1e-6);
}
