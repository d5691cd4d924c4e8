#include <catch2/catch.hpp>

#include "calibrate/search/surrogate.h"
#include "calibrate/study/tests.h"

using namespace pastefit;

namespace {

/// A simulation at x with two residuals: a line in x moved by `shift`, and a constant.
Response single(double x, double shift) {
  Response response;
  response.point = UnitPoint::Constant(1, x);
  response.packings = {1};
  response.residuals = Eigen::Vector2d(4 * x - 2 + shift, 1 + shift / 3);
  response.misfit = 0.5 * response.residuals.squaredNorm();
  return response;
}

std::vector<Response> line(double shift) {
  std::vector<Response> singles;
  for (int k = 0; k <= 10; ++k) singles.push_back(single(0.1 * k, shift));
  return singles;
}

}  // namespace

TEST_CASE("coarse answers are moved onto the fine ones, each reading by its own bias") {
  const std::vector<Response> fine{single(0.33, 3), single(0.58, 3)};
  const std::vector<Response> moved = corrected(line(0), fine);
  REQUIRE(moved.size() == 11);
  for (int k = 0; k <= 10; ++k) {
    const Response truth = single(0.1 * k, 3);
    CHECK((moved[k].residuals - truth.residuals).norm() < 0.05);
    CHECK(moved[k].misfit == Approx(0.5 * moved[k].residuals.squaredNorm()));
  }
}

TEST_CASE("without fine simulations, or with failed ones only, coarse answers stay as they are") {
  Response failed = single(0.5, 100);
  failed.failed = true;
  const std::vector<Response> none, useless{failed};
  CHECK(corrected(line(0), none)[4].residuals == line(0)[4].residuals);
  CHECK(corrected(line(0), useless)[4].residuals == line(0)[4].residuals);
}

TEST_CASE("failed coarse simulations tell nothing") {
  std::vector<Response> coarse = line(0);
  coarse[3].failed = true;
  CHECK(corrected(coarse, line(1)).size() == 10);
  for (Response& one : coarse) one.failed = true;
  CHECK(corrected(coarse, line(1)).empty());
}

TEST_CASE("coarse grains are larger in every respect") {
  Study study;
  study.tests.emplace_back();
  specimen_of(study.tests[0].lab.test).grains = {SizeDistribution::normal, 0.008, 0.001, 0.006, 0.010};
  const GrainSizes grains = specimen_of(with_coarse_grains(study).tests.at(0).lab.test).grains;
  CHECK(grains.radius_m == Approx(0.012));
  CHECK(grains.standard_deviation_m == Approx(0.0015));
  CHECK(grains.smallest_m == Approx(0.009));
  CHECK(grains.largest_m == Approx(0.015));
}
