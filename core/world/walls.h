#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/laws/constants.h"
#include "core/vec3.h"

namespace pastefit {

/// Infinite plane through `point`; grains are on the side of `normal`. One-sided: a grain deep in it is still pushed
/// out.
struct Plane {
  Vec3 point;
  Vec3 normal{0, 0, 1};
};

/// Flat rectangle without thickness, solid from both sides, with its four edges. `along` and `across` are orthogonal
/// unit vectors in its plane.
struct Plate {
  Vec3 centre;
  Vec3 along{1, 0, 0}, across{0, 1, 0};
  double half_length = 0, half_width = 0;  ///< along, across [m]
};

/// Side of a frustum without thickness, with a vertical axis through `base`; solid from both sides, with both rims. A
/// cylinder has two equal radii.
struct Shell {
  Vec3 base;  ///< centre of the lower rim
  double base_radius = 0, top_radius = 0, height = 0;
};

/// An endless row of equal solid rectangular bars along y, one every `pitch` along x. `base` is the centre of one bar's
/// foot; bars are above it if the height is positive, below it if negative. Requirement: a grain fits between two bars,
/// so that it touches one at a time.
struct Ribs {
  Vec3 base;
  double thickness = 0, height = 0, pitch = 1;  ///< along x, along z, along x [m]
};

using Shape = std::variant<Plane, Plate, Shell, Ribs>;

/// The point of a wall nearest to a grain: unit vector from the grain's centre to it, and its distance, which is
/// negative behind a one-sided plane.
template <class Real>
struct BasicNearest {
  BasicVec3<Real> direction;
  Real distance{};
};
using Nearest = BasicNearest<double>;
Nearest nearest(const Shape& shape, const Vec3& centre);

/// A boundary: shape, surface, rigid motion, and loads of the grains.
struct Wall {
  std::string name;
  Shape shape;
  PairConstants pair;
  Vec3 velocity;          ///< of the point `pivot` [m/s]
  Vec3 angular_velocity;  ///< about `pivot` [rad/s]
  Vec3 pivot;
  Vec3 velocity_before, angular_velocity_before;  ///< those of the previous move
  Vec3 force;                                     ///< of the grains on the wall at the last step [N]
  Vec3 torque;                                    ///< about `pivot` [N m]
};

/// Moves the wall rigidly over `dt`. Rotation is about the y axis through `pivot` only.
void move(Wall& wall, double dt);

}  // namespace pastefit
