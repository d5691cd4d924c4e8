#include "core/world/walls.h"

#include <algorithm>
#include <cmath>

namespace pastefit {

namespace {

constexpr double kOnSurface = 1e-12;  // [m]; closer than this the direction is taken from the shape, not from the point

Nearest towards(const Vec3& from, const Vec3& to, const Vec3& fallback) {
  const Vec3 between = to - from;
  const double distance = norm(between);
  if (distance < kOnSurface) return {fallback, distance};
  return {(1 / distance) * between, distance};
}

Nearest nearest_on(const Plane& plane, const Vec3& p) {
  return {-plane.normal, dot(p - plane.point, plane.normal)};
}

Nearest nearest_on(const Plate& plate, const Vec3& p) {
  const Vec3 from_centre = p - plate.centre;
  const double u = std::clamp(dot(from_centre, plate.along), -plate.half_length, plate.half_length);
  const double v = std::clamp(dot(from_centre, plate.across), -plate.half_width, plate.half_width);
  return towards(p, plate.centre + u * plate.along + v * plate.across, -cross(plate.along, plate.across));
}

/// In the plane of axis and grain the shell is a straight line from the lower rim to the upper one.
Nearest nearest_on(const Shell& shell, const Vec3& p) {
  const Vec3 q = p - shell.base;
  const double rho = std::sqrt(q.x * q.x + q.y * q.y);
  const Vec3 outward = rho > kOnSurface ? Vec3{q.x / rho, q.y / rho, 0} : Vec3{1, 0, 0};
  const double run = shell.top_radius - shell.base_radius;
  const double share = std::clamp(
      ((rho - shell.base_radius) * run + q.z * shell.height) / (run * run + shell.height * shell.height), 0.0, 1.0);
  const double reach = shell.base_radius + share * run;
  return towards(p, shell.base + reach * outward + Vec3{0, 0, share * shell.height}, outward);
}

Vec3 turn_about_y(const Vec3& a, double sine, double cosine) {
  return {cosine * a.x + sine * a.z, a.y, cosine * a.z - sine * a.x};
}

}  // namespace

Nearest nearest(const Shape& shape, const Vec3& centre) {
  return std::visit([&](const auto& s) { return nearest_on(s, centre); }, shape);
}

void move(Wall& wall, double dt) {
  wall.velocity_before = wall.velocity;
  wall.angular_velocity_before = wall.angular_velocity;
  const Vec3 shift = dt * wall.velocity;
  // Cayley's rotation: exactly orthogonal, right to third order in the angle of one step, and free of library functions
  // whose last bit differs between processors.
  const double half = 0.5 * dt * wall.angular_velocity.y, scale = 1 / (1 + half * half);
  const double sine = 2 * half * scale, cosine = (1 - half * half) * scale;
  const auto carry = [&](Vec3& point) { point = wall.pivot + turn_about_y(point - wall.pivot, sine, cosine) + shift; };
  if (auto* plane = std::get_if<Plane>(&wall.shape)) {
    carry(plane->point);
    plane->normal = turn_about_y(plane->normal, sine, cosine);
  } else if (auto* plate = std::get_if<Plate>(&wall.shape)) {
    carry(plate->centre);
    plate->along = turn_about_y(plate->along, sine, cosine);
    plate->across = turn_about_y(plate->across, sine, cosine);
  } else if (auto* shell = std::get_if<Shell>(&wall.shape)) {
    shell->base += shift;
  }
  wall.pivot += shift;
}

}  // namespace pastefit
