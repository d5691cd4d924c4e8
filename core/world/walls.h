#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/laws/constants.h"
#include "core/vec3.h"

namespace pastefit {

/// Infinite plane through `point`; grains are on the side `normal` points to. One-sided: a grain deep in it is still
/// pushed out.
struct Plane {
  Vec3 point;
  Vec3 normal{0, 0, 1};
};

/// Flat rectangle without thickness, solid from both sides, with its four edges.
/// `along` and `across` are orthogonal unit vectors in its plane.
struct Plate {
  Vec3 centre;
  Vec3 along{1, 0, 0}, across{0, 1, 0};
  double half_length = 0, half_width = 0;  ///< along, across [m]
};

/// Side of a frustum without thickness, axis vertical through `base`; solid from both sides, with both rims.
/// A cylinder has two equal radii.
struct Shell {
  Vec3 base;  ///< centre of the lower rim
  double base_radius = 0, top_radius = 0, height = 0;
};

/// A row of equal bars across, along y, without end: solid, rectangular, one every `pitch` along x. `base` is the
/// middle of one bar's foot; they stand on it where the height is positive, and hang from it where it is negative.
/// Requirement: a grain fits between two of them, so that it touches one at a time.
struct Ribs {
  Vec3 base;
  double thickness = 0, height = 0, pitch = 1;  ///< along x, along z, along x [m]
};

using Shape = std::variant<Plane, Plate, Shell, Ribs>;

/// The nearest point of a wall as a grain sees it: unit vector from the grain's centre to it, and its distance.
/// Behind a one-sided plane the distance is negative.
template <class Real>
struct BasicNearest {
  BasicVec3<Real> direction;
  Real distance{};
};
using Nearest = BasicNearest<double>;
Nearest nearest(const Shape& shape, const Vec3& centre);

/// A boundary: shape, surface, rigid motion, and what the grains do to it.
struct Wall {
  std::string name;
  Shape shape;
  PairConstants pair;
  Vec3 velocity;          ///< of the point `pivot` [m/s]
  Vec3 angular_velocity;  ///< about `pivot` [rad/s]
  Vec3 pivot;
  Vec3 velocity_before, angular_velocity_before;  ///< those of the move that led here
  Vec3 force;                                     ///< of the grains on the wall at the last step [N]
  Vec3 torque;                                    ///< about `pivot` [N m]
};

/// Moves the wall by its own rigid motion over `dt`. Rotation is about the y axis through `pivot` only.
void move(Wall& wall, double dt);

}  // namespace pastefit
