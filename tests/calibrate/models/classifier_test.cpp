#include "calibrate/models/classifier.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "../search/synthetic.h"

using namespace pastefit;

namespace {

/// Happens with this probability: seldom on the left, often on the right.
double truth(const UnitPoint& point) {
  return 1 / (1 + std::exp(-12 * (point[0] - 0.5)));
}

Classifier learnt_from(int count, std::uint64_t seed) {
  const std::vector<UnitPoint> points = screening_points(3, count, seed);
  std::vector<bool> labels;
  for (std::size_t i = 0; i < points.size(); ++i) labels.push_back(synthetic::uniform(seed, i) < truth(points[i]));
  return Classifier(points, labels);
}

}  // namespace

TEST_CASE("the probability of what happens by chance is learnt from yes and no") {
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Classifier classifier = learnt_from(60, seed);
    for (const UnitPoint& point : screening_points(3, 50, seed + 100))
      squares += std::pow(classifier.probability(point) - truth(point), 2) / 500;
  }
  INFO("root mean square error " << std::sqrt(squares));
  CHECK(std::sqrt(squares) < 0.17);  // 0.4 of a probability of 0.5 everywhere
}

TEST_CASE("one label at one point: the mode satisfies its own equation") {
  // K = v, one label 1: the mode f solves f = m + v (1 - logistic(f)); here by bisection.
  const UnitPoint point = UnitPoint::Constant(2, 0.3);
  const Classifier classifier({&point, 1}, {true});
  const double m = std::log(1.5 / 0.5);
  // A single label tells of no scale: the variance of most evidence is on the grid.
  bool found = false;
  for (const double v : {0.5, 2.0, 6.0}) {
    double low = m, high = m + v;
    for (int k = 0; k < 200; ++k) {
      const double f = 0.5 * (low + high);
      (f < m + v * (1 - 1 / (1 + std::exp(-f))) ? low : high) = f;
    }
    const double p = 1 / (1 + std::exp(-low)), w = p * (1 - p), left = v - v * v * w / (1 + w * v);
    const double expected = 1 / (1 + std::exp(-low / std::sqrt(1 + std::acos(-1.0) * left / 8)));
    found = found || std::abs(classifier.probability(point) - expected) < 1e-4;
  }
  CHECK(found);
}

TEST_CASE("what never happened is unlikely everywhere, and a probability of a point far off is the share") {
  const std::vector<UnitPoint> points = screening_points(4, 30, 5);
  const Classifier never(points, std::vector<bool>(30, false));
  for (const UnitPoint& point : screening_points(4, 20, 6)) CHECK(never.probability(point) < 0.05);
}
