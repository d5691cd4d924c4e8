#include "calibrate/verify/force_curve.h"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "core/laws/constants.h"

namespace pastefit {
namespace {

constexpr double kRadius = 0.008;

ContactModel paste(BridgeShape shape) {
  ContactModel model;
  model.cohesion_n = 0.2;
  model.bridge = {shape, BridgeFormation::film, -1500, 40, 0.3, -0.004, 0.0012, 1e-9, 3, 0.2, 0.3};
  return model;
}

}  // namespace

TEST_CASE("every attraction has a closed form of its own, which agrees with the engine's") {
  for (int row = 1; row <= static_cast<int>(BridgeShape::last); ++row) {
    const Bridge bridge = paste(static_cast<BridgeShape>(row)).bridge;
    const double at_touch = attraction_at_touch(bridge, kRadius), reach = rupture_gap(bridge, kRadius);
    REQUIRE(at_touch > 0);
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      INFO("shape " << row << ", " << share << " of its reach");
      const double closed = closed_bridge_n(bridge, kRadius, -share * reach);
      CHECK(closed == Approx(bridge_force(bridge, kRadius, -share * reach)).epsilon(1e-12).margin(1e-13 * at_touch));
    }
  }
}

TEST_CASE("an attraction without a closed form is not compared with itself") {
  const auto unheard = static_cast<BridgeShape>(static_cast<int>(BridgeShape::last) + 1);
  CHECK_THROWS_AS(attraction_n(paste(unheard), {kRadius, kRadius, kRadius}, 0), std::logic_error);
}

}  // namespace pastefit
