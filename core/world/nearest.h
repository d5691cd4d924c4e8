#pragma once

#include <algorithm>
#include <cmath>

#include "core/world/walls.h"

namespace pastefit {

// One shape each: whoever asks for many grains visits the wall's shape once, and the answer is inlined.

inline constexpr double kOnSurface =
    1e-12;  // [m]; closer than this the direction is taken from the shape, not from the point

inline Nearest towards(const Vec3& from, const Vec3& to, const Vec3& fallback) {
  const Vec3 between = to - from;
  const double distance = norm(between);
  if (distance < kOnSurface) return {fallback, distance};
  return {(1 / distance) * between, distance};
}

inline Nearest nearest_on(const Plane& plane, const Vec3& p) {
  return {-plane.normal, dot(p - plane.point, plane.normal)};
}

inline Nearest nearest_on(const Plate& plate, const Vec3& p) {
  const Vec3 from_centre = p - plate.centre;
  const double u = std::clamp(dot(from_centre, plate.along), -plate.half_length, plate.half_length);
  const double v = std::clamp(dot(from_centre, plate.across), -plate.half_width, plate.half_width);
  return towards(p, plate.centre + u * plate.along + v * plate.across, -cross(plate.along, plate.across));
}

/// In the plane of axis and grain the shell is a straight line from the lower rim to the upper one.
inline Nearest nearest_on(const Shell& shell, const Vec3& p) {
  const Vec3 q = p - shell.base;
  const double rho = std::sqrt(q.x * q.x + q.y * q.y);
  const Vec3 outward = rho > kOnSurface ? Vec3{q.x / rho, q.y / rho, 0} : Vec3{1, 0, 0};
  const double run = shell.top_radius - shell.base_radius;
  const double share = std::clamp(
      ((rho - shell.base_radius) * run + q.z * shell.height) / (run * run + shell.height * shell.height), 0.0, 1.0);
  const double reach = shell.base_radius + share * run;
  return towards(p, shell.base + reach * outward + Vec3{0, 0, share * shell.height}, outward);
}

inline Nearest nearest_on(const Ribs& ribs, const Vec3& p) {
  const Vec3 q = p - ribs.base;
  const double x = q.x - ribs.pitch * std::floor(q.x / ribs.pitch + 0.5);  // from the middle of the nearest bar
  const double half = 0.5 * ribs.thickness, low = std::min(ribs.height, 0.0), high = std::max(ribs.height, 0.0);
  const Vec3 way{std::clamp(x, -half, half) - x, 0, std::clamp(q.z, low, high) - q.z};
  return towards({}, way, {x > 0 ? -1.0 : 1.0, 0, 0});
}

/// True only if no point of the shape is within `range` of the point; cheaper than to look for the nearest one.
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
