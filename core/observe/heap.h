#pragma once

#include <vector>

#include "core/world/particles.h"

namespace pastefit {

/// Surface of a heap on the horizontal table z = 0, as heights over a square grid.
///
/// The upper envelope of the spheres is closed by a ball of twice the mean radius: the pits between grains, into which
/// no ruler of the laboratory would dip because paste fills them, are bridged; the tops of grains stay where they are.
class HeightField {
 public:
  /// Shapes: (2 half_width/spacing + 1)^2 points, spacing a quarter of `mean_radius` [m]. Grains outside are ignored.
  HeightField(const Particles& particles, double mean_radius, double half_width);

  double at(int ix, int iy) const { return height_[iy * n_ + ix]; }
  int points() const { return n_; }
  double spacing() const { return spacing_; }
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

/// Mean of the closed surface over a disc about the axis [m]: a flat-ended probe let down at the mould's axis. What
/// ASTM C143 reads (displaced centre of the top).
double height_at_axis(const Particles& particles, double mean_radius, double probe_diameter);

/// Mean of the extents along x and y of the connected body that covers the axis [m]; grains that lie apart by more than
/// one mean radius do not belong to it. What a person measures with a tape on a flow table.
double spread_diameter(const Particles& particles, double mean_radius);

/// The plateau of a heap after the drop, along the direction hinge (x < 0) to free edge (x > 0).
struct Plateau {
  double width = 0;  ///< length of the part about the axis that stands at 0.8 of the axis height or more [m]
  double sag = 0;    ///< surface at its hinge-side edge minus free-side edge, from a straight line fitted to it [m]
};

/// Read from the profile along x, the mean of the closed surface over a strip of the probe's width.
Plateau plateau(const Particles& particles, double mean_radius, double probe_diameter, double half_width);

}  // namespace pastefit
