#pragma once

#include <algorithm>
#include <cmath>

#include "core/laws/pack.h"
#include "core/world/walls.h"

namespace pastefit {

// One function per shape, inlined: a caller with many grains visits the wall's shape once. For packs and numbers.

inline constexpr double kOnSurface =
    1e-12;  // [m]; closer than this the direction is taken from the shape, not from the point

template <class Real>
PASTEFIT_INLINE BasicVec3<Real> in_lanes(const Vec3& v) {
  return {Real(v.x), Real(v.y), Real(v.z)};
}

template <class Real>
PASTEFIT_INLINE BasicNearest<Real> towards(const BasicVec3<Real>& between, const BasicVec3<Real>& fallback) {
  const Real distance = square_root(dot(between, between));
  const auto apart = distance >= Real(kOnSurface);
  const Real inverse = Real(1.0) / select(apart, distance, Real(1.0));
  return {{select(apart, inverse * between.x, fallback.x), select(apart, inverse * between.y, fallback.y),
           select(apart, inverse * between.z, fallback.z)},
          distance};
}

template <class Real>
PASTEFIT_INLINE Real clamped(Real value, Real low, Real high) {
  return smaller(larger(value, low), high);
}

template <class Real>
PASTEFIT_INLINE BasicNearest<Real> nearest_on(const Plane& plane, const BasicVec3<Real>& p) {
  return {in_lanes<Real>(-plane.normal), dot(p - in_lanes<Real>(plane.point), in_lanes<Real>(plane.normal))};
}

template <class Real>
PASTEFIT_INLINE BasicNearest<Real> nearest_on(const Plate& plate, const BasicVec3<Real>& p) {
  const BasicVec3<Real> along = in_lanes<Real>(plate.along), across = in_lanes<Real>(plate.across);
  const BasicVec3<Real> from_centre = p - in_lanes<Real>(plate.centre);
  const Real u = clamped(dot(from_centre, along), Real(-plate.half_length), Real(plate.half_length));
  const Real v = clamped(dot(from_centre, across), Real(-plate.half_width), Real(plate.half_width));
  return towards(u * along + v * across - from_centre, in_lanes<Real>(-cross(plate.along, plate.across)));
}

/// In the plane of axis and grain the shell is a straight line from the lower rim to the upper one.
template <class Real>
PASTEFIT_INLINE BasicNearest<Real> nearest_on(const Shell& shell, const BasicVec3<Real>& p) {
  const BasicVec3<Real> q = p - in_lanes<Real>(shell.base);
  const Real rho = square_root(q.x * q.x + q.y * q.y);
  const auto beside_axis = rho > Real(kOnSurface);
  const Real divisor = select(beside_axis, rho, Real(1.0));
  const BasicVec3<Real> outward{select(beside_axis, q.x / divisor, Real(1.0)),
                                select(beside_axis, q.y / divisor, Real(0.0)), Real(0.0)};
  const double run = shell.top_radius - shell.base_radius;
  const Real base_radius(shell.base_radius), height(shell.height);
  const Real share =
      clamped(((rho - base_radius) * Real(run) + q.z * height) / Real(run * run + shell.height * shell.height),
              Real(0.0), Real(1.0));
  const Real reach = base_radius + share * Real(run);
  const BasicVec3<Real> there{reach * outward.x, reach * outward.y, share * height};
  return towards(there - q, outward);
}

template <class Real>
PASTEFIT_INLINE BasicNearest<Real> nearest_on(const Ribs& ribs, const BasicVec3<Real>& p) {
  const BasicVec3<Real> q = p - in_lanes<Real>(ribs.base);
  const Real pitch(ribs.pitch);
  const Real x = q.x - pitch * rounded_down(q.x / pitch + Real(0.5));  // from the middle of the nearest bar
  const Real half(0.5 * ribs.thickness);
  const Real low(std::min(ribs.height, 0.0)), high(std::max(ribs.height, 0.0));
  const BasicVec3<Real> offset{clamped(x, -half, half) - x, Real(0.0), clamped(q.z, low, high) - q.z};
  return towards(offset, {select(x > Real(0.0), Real(-1.0), Real(1.0)), Real(0.0), Real(0.0)});
}

/// True only if no point of the shape is within `range` of the point; cheaper than the nearest point.
inline bool is_surely_beyond(const Plane& plane, const Vec3& p, double range) {
  return dot(p - plane.point, plane.normal) >= range;
}

inline bool is_surely_beyond(const Plate& plate, const Vec3& p, double range) {
  const Vec3 from_centre = p - plate.centre;
  return std::fabs(dot(from_centre, cross(plate.along, plate.across))) >= range;
}

inline bool is_surely_beyond(const Ribs& ribs, const Vec3& p, double range) {
  const double z = p.z - ribs.base.z;
  return z <= std::min(ribs.height, 0.0) - range || z >= std::max(ribs.height, 0.0) + range;
}

inline bool is_surely_beyond(const Shell& shell, const Vec3& p, double range) {
  const Vec3 q = p - shell.base;
  if (q.z <= -range || q.z >= shell.height + range) return true;
  const double square = q.x * q.x + q.y * q.y;
  const double inner = std::min(shell.base_radius, shell.top_radius) - range;
  const double outer = std::max(shell.base_radius, shell.top_radius) + range;
  return (inner > 0 && square <= inner * inner) || square >= outer * outer;
}

}  // namespace pastefit
