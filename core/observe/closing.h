#pragma once

namespace pastefit {

// How surfaces and outlines are taken off grains, in mean radii.
inline constexpr double kPointsPerRadius = 4;
inline constexpr double kClosingBall = 2;  ///< radius of the ball that bridges what no ruler would dip into

}  // namespace pastefit
