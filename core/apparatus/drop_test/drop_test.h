#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "core/apparatus/dimension.h"
#include "core/apparatus/reading_kind.h"
#include "core/apparatus/specimen.h"
#include "core/result.h"
#include "core/step/run.h"

namespace pastefit {

/// The drop test as one value: a ball of the material falls on a plate of the same material, level and, if
/// `plate_tilt_rad` is above 0, a second time tilted. The ball is one grain: its radius is `grains.radius_m`, its
/// density `bulk_density_kg_m3`, as there is nothing between grains. The plate is as hard, rough and sticky as the
/// ball.
///
/// Without attraction a ball rises to e^2 of the height it fell; on a plate tilted by t it slides throughout the
/// contact if tan t > 3.5 mu (1 + e), and leaves with a spin of 2.5 mu (1 + e) v cos t/R, v its speed at touch. Source
/// of the second: Chung & Ooi, Granular Matter 13 (2011) 643-656. Both are limits of hard balls: a soft one is slowed
/// by its weight while it touches, and its lever is shorter by the overlap (spin 1.7 % less at 1e9 Pa and 3 m/s). A
/// ball that sticks may spin as much as one that slides at another friction. Limits: no air.
struct DropTest : Specimen {
  double drop_height_m = 0.5;  ///< the way the ball falls until it touches the plate
  double plate_tilt_rad = 0;   ///< of the second drop; 0: there is none
};

inline constexpr std::array<Dimension<DropTest>, 2> drop_dimensions{{
    {"drop_height_m", &DropTest::drop_height_m, 1e-3, 20, "the way the ball falls until it touches the plate"},
    {"plate_tilt_rad", &DropTest::plate_tilt_rad, 0, 80 * std::numbers::pi / 180,
     "of the tilted plate; 0 or left out: only the level one", true},
}};

/// Every fault that keeps this test from being simulated; places are paths of fields, e.g. "drop_height_m".
Faults validate(const DropTest& test);

/// Runs the drops, each from just above the plate with the speed that it has there. Same test, options and program:
/// same bits, whatever the seed: nothing in it is random. Requirement: `validate(test)` is empty.
Outcome simulate(const DropTest& test, const RunOptions& options = {});

/// Every reading of drop tests, in the order in which a simulation gives them; those that this one lacks say so.
std::vector<ReadingKind> reading_kinds(const DropTest& test);

/// Speed of the ball when it touches the plate [m/s].
double impact_speed_m_s(const DropTest& test);

}  // namespace pastefit
