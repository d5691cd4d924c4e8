#pragma once

#include <array>
#include <vector>

#include "core/world/particles.h"

namespace pastefit {

/// Side view of a heap, along y: the highest point at each x, with gaps narrower than a ball of twice the mean radius
/// bridged. Linear between its points; zero beyond them.
struct Outline {
  double first_x_m = 0, spacing_m = 1;
  std::vector<double> height_m;

  double at(double x_m) const;
};
Outline outline(const Particles& particles, double mean_radius);

/// Length of the part about x = 0 that is at least 0.8 of the height there [m].
double plateau_width(const Outline& outline);

/// A point of a measured outline: x and z [m].
using OutlinePoint = std::array<double, 2>;

/// Root mean square difference in height between an outline and a measured one, over the measured width [m].
/// Requirement: at least two points, x ascending; linear in between.
double rms_difference(const Outline& outline, const std::vector<OutlinePoint>& measured);

// Sampling of surfaces and outlines, in mean radii.
inline constexpr double kPointsPerRadius = 4;
inline constexpr double kClosingBall = 2;  ///< radius of the closing ball

}  // namespace pastefit
