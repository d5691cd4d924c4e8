#include <catch2/catch.hpp>
#include <stdexcept>

#include "calibrate/search/screening.h"

using namespace pastefit;

TEST_CASE("screening begins in the middle of the cube, not in its corner") {
  const std::vector<UnitPoint> points = screening_points(5, 8, 0);
  REQUIRE(points.size() == 8);
  CHECK(points[0] == UnitPoint::Constant(5, 0.5));
}

TEST_CASE("fifteen screening points fall one into each sixteenth of every coordinate, but for the first") {
  const std::vector<UnitPoint> points = screening_points(5, 15, 0);
  for (int k = 0; k < 5; ++k) {
    std::vector<int> hits(16, 0);
    for (const UnitPoint& point : points) ++hits.at(static_cast<std::size_t>(point[k] * 16));
    for (std::size_t cell = 1; cell < 16; ++cell) CHECK(hits[cell] == 1);
  }
}

TEST_CASE("a seed shifts the points within the cube, and the same seed always alike") {
  const std::vector<UnitPoint> points = screening_points(3, 64, 7);
  CHECK(points[5] == screening_points(3, 6, 7)[5]);
  CHECK(points[5] != screening_points(3, 6, 8)[5]);
  for (const UnitPoint& point : points) {
    CHECK(point.minCoeff() >= 0);
    CHECK(point.maxCoeff() < 1);
  }
}

TEST_CASE("screening without coordinates is a programming error") {
  CHECK_THROWS_AS(screening_points(0, 4, 1), std::logic_error);
}
