#pragma once

#include <optional>
#include <vector>

#include "core/world/particles.h"

namespace pastefit {

/// Surface of a heap on the horizontal table z = 0, as heights on a square grid.
///
/// The upper envelope of the spheres is closed by a ball of twice the mean radius: pits between grains, which paste
/// would fill, are bridged; the tops of grains are unchanged.
class HeightField {
 public:
  /// Shapes: (2 half_width/spacing + 1)^2 points about (x, y); spacing is a quarter of `mean_radius` [m]. Grains
  /// outside are ignored.
  HeightField(const Particles& particles, double mean_radius, double half_width, double x = 0, double y = 0);

  double at(int ix, int iy) const { return height_[iy * n_ + ix]; }
  int points() const { return n_; }
  double spacing() const { return spacing_; }
  /// From the centre of the field.
  double coordinate(int i) const {
    const int middle = n_ / 2;
    return (i - middle) * spacing_;
  }

 private:
  int n_ = 0;
  double spacing_ = 0;
  std::vector<double> height_;
};

/// Highest point of any grain [m], as in EN 12350-2.
double highest_point(const Particles& particles);

/// Lengths that no longer change when a heap is at rest [m]: its highest point, the mean height of its grains, and
/// their mean distance from the axis.
std::vector<double> rest_measure_of_heap(const Particles& particles);

/// A flat-ended probe of this diameter on a heap [m].
struct Disc {
  double x = 0, y = 0;
  double diameter = 0;
};

/// Mean of the closed surface over a disc [m].
double mean_height(const Particles& particles, double mean_radius, const Disc& disc);

/// Slope along x of the plane fitted to the closed surface over a disc; positive if it rises with x.
double slope_along_x(const Particles& particles, double mean_radius, const Disc& disc);

/// Angle of repose of a heap on the table [rad]: slope of the straight line through its flank between these shares of
/// its height. Empty if the heap is too low or too small for such a flank.
///
/// The axis is the vertical through the grains' centre of mass. The radius at a height z is the mean over 48 directions
/// of the farthest point of the closed surface at z or above; the height is the mean of the closed surface over a disc
/// of five mean radii about the axis. The line is a least squares fit of the radius over levels half a mean radius
/// apart.
/// Requirement: 0 <= lower < upper <= 1.
std::optional<double> flank_angle(const Particles& particles, double mean_radius, double lower, double upper);

/// Widths of the heap in plan [m], as a tape measures them on a flow table. The heap is the connected body with at
/// least half of the grains; grains more than one mean radius away from it do not count. If there is no such body the
/// grains have scattered and all count, so that a heap that flows farther is never read as narrower.
struct Widths {
  double mean = 0;        ///< over 24 directions, evenly spaced
  double orthogonal = 0;  ///< mean of the widths along x and y, as in the standards
};
Widths widths(const Particles& particles, double mean_radius);

}  // namespace pastefit
