#include "core/random.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace pastefit;

TEST_CASE("a stream's numbers depend on seed, name and counter only") {
  const RandomStream a(7, "position"), again(7, "position"), other(7, "radius"), seed(8, "position");
  CHECK(a.bits(3) == again.bits(3));
  CHECK(a.bits(3) != other.bits(3));
  CHECK(a.bits(3) != seed.bits(3));
  CHECK(a.bits(3) != a.bits(4));
}

TEST_CASE("uniform and normal numbers have the moments they should") {
  const RandomStream stream(1, "moments");
  const int n = 200000;
  double mean = 0, square = 0, normal_mean = 0, normal_square = 0;
  for (int k = 0; k < n; ++k) {
    const double u = stream.uniform(k);
    REQUIRE((u >= 0 && u < 1));
    mean += u / n;
    square += u * u / n;
    const double z = stream.normal(k);
    normal_mean += z / n;
    normal_square += z * z / n;
  }
  CHECK(mean == Approx(0.5).margin(0.003));
  CHECK(square == Approx(1.0 / 3).margin(0.003));
  CHECK(normal_mean == Approx(0).margin(0.01));
  CHECK(normal_square == Approx(1).margin(0.015));
}
