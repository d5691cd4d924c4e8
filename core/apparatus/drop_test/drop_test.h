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

/// The drop test: a ball of the material falls on a plate of the same material, which is level and, if `plate_tilt_rad`
/// > 0, tilted in a second drop. The ball is one grain: its radius is `grains.radius_m`, its density
/// `bulk_density_kg_m3`, since there are no voids. The plate has the stiffness, friction and adhesion of the ball.
///
/// Without attraction a ball rebounds to e^2 of its height of fall. On a plate tilted by t it slides throughout the
/// contact if tan t > 3.5 mu (1 + e), and leaves with a spin of 2.5 mu (1 + e) v cos t/R, with v its speed at touch
/// (Chung & Ooi, Granular Matter 13 (2011) 643-656). Both are limits of hard balls: a soft ball is slowed by its weight
/// during contact, and its lever is shorter by the overlap (spin 1.7 % less at 1e9 Pa and 3 m/s). An adhesive ball may
/// have the spin of a sliding one with another friction. Limits: no air resistance.
struct DropTest : Specimen {
  double drop_height_m = 0.5;  ///< height of fall until the ball touches the plate
  double plate_tilt_rad = 0;   ///< of the second drop; 0: no second drop
};

inline constexpr std::array<Dimension<DropTest>, 2> drop_dimensions{{
    {"drop_height_m", &DropTest::drop_height_m, 1e-3, 20, "height of fall until the ball touches the plate"},
    {"plate_tilt_rad", &DropTest::plate_tilt_rad, 0, 80 * std::numbers::pi / 180,
     "angle of the tilted plate; 0 or left out: the ball drops only on the level plate", true},
}};

/// Returns the reasons why the test cannot run; empty if it can. Places are field paths, e.g. "drop_height_m".
Faults validate(const DropTest& test);

/// Runs the drops, each from just above the plate at the speed reached there. Deterministic, and independent of the
/// seed: nothing is random. Requirement: `validate(test)` is empty.
Outcome simulate(const DropTest& test, const RunOptions& options = {});

/// All readings of drop tests, in the order of the simulation; those that this test cannot give have a `lack`.
std::vector<ReadingKind> reading_kinds(const DropTest& test);

/// Speed of the ball when it touches the plate [m/s].
double impact_speed_m_s(const DropTest& test);

}  // namespace pastefit
