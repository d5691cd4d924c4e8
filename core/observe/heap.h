#pragma once

#include <optional>
#include <vector>

#include "core/world/particles.h"

namespace pastefit {

/// Surface of a heap on the horizontal table z = 0, as heights over a square grid.
///
/// The upper envelope of the spheres is closed by a ball of twice the mean radius: the pits between grains, into which
/// no ruler of the laboratory would dip because paste fills them, are bridged; the tops of grains stay where they are.
class HeightField {
 public:
  /// Shapes: (2 half_width/spacing + 1)^2 points about (x, y), spacing a quarter of `mean_radius` [m]. Grains outside
  /// are ignored.
  HeightField(const Particles& particles, double mean_radius, double half_width, double x = 0, double y = 0);

  double at(int ix, int iy) const { return height_[iy * n_ + ix]; }
  int points() const { return n_; }
  double spacing() const { return spacing_; }
  /// From the middle of the field.
  double coordinate(int i) const {
    const int middle = n_ / 2;
    return (i - middle) * spacing_;
  }

 private:
  int n_ = 0;
  double spacing_ = 0;
  std::vector<double> height_;
};

/// Highest point of any grain [m]. What EN 12350-2 reads.
double highest_point(const Particles& particles);

/// What stays where it is once a heap rests [m]: its highest point, the mean height of its grains, and their mean
/// distance from the axis.
std::vector<double> rest_measure_of_heap(const Particles& particles);

/// Where a flat-ended probe of this diameter is let down on a heap [m].
struct Disc {
  double x = 0, y = 0;
  double diameter = 0;
};

/// Mean of the closed surface over a disc [m].
double mean_height(const Particles& particles, double mean_radius, const Disc& disc);

/// Slope along x of the plane fitted to the closed surface over a disc; positive where it rises with x.
double slope_along_x(const Particles& particles, double mean_radius, const Disc& disc);

/// Angle of repose of a heap on the table [rad]: that of the straight line through its flank between these shares of
/// its height. Nothing if the heap is too low or too small to have such a flank.
///
/// About the vertical through the grains' centre of mass, the heap's radius at a height z is the mean over 48
/// directions of how far the closed surface reaches at z or above; its height is the mean of the closed surface over a
/// disc of five mean radii about that axis. The line is the least squares fit of the radius over levels half a mean
/// radius apart. Requirement: 0 <= lower < upper <= 1.
std::optional<double> flank_angle(const Particles& particles, double mean_radius, double lower, double upper);

/// Widths in plan of the heap, the connected body that has at least half of the grains [m]; those that lie apart from
/// it by more than one mean radius do not belong to it. Where no body has so many the grains have scattered, and all of
/// them count: what flows farther is never read as narrower. What a person measures with a tape on a flow table.
struct Widths {
  double mean = 0;        ///< over 24 directions, evenly about the axis
  double orthogonal = 0;  ///< mean of those along x and y, as the standards have it
};
Widths widths(const Particles& particles, double mean_radius);

}  // namespace pastefit
