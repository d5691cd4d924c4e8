#include "core/world/walls.h"

#include "core/world/nearest.h"

namespace pastefit {

namespace {

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
  // Cayley's rotation: exactly orthogonal, accurate to third order in the angle of a step, and free of library
  // functions whose last bit differs between processors.
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
  } else if (auto* ribs = std::get_if<Ribs>(&wall.shape)) {
    ribs->base += shift;
  }
  wall.pivot += shift;
}

}  // namespace pastefit
