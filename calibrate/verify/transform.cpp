#include "calibrate/verify/transform.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace pastefit {

namespace {

const Vec3 kShift{0.37, -0.21, 0.53};  // [m]
const Vec3 kBoost{0.3, -0.7, 0.45};    // [m/s]
constexpr double kTurn = 0.7;          // [rad]
constexpr double kLonger = 3;

Vec3 turn(const Vec3& v) {
  const double c = std::cos(kTurn), s = std::sin(kTurn);
  return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

/// What the transformation does to a vector that has a direction but no place.
Vec3 arrow(const Vec3& v, Transform transform) {
  if (transform == Transform::turn) return turn(v);
  if (transform == Transform::mirror) return {v.x, -v.y, v.z};
  return v;
}

Vec3 place(const Vec3& v, Transform transform) {
  if (transform == Transform::shift) return v + kShift;
  if (transform == Transform::lengthen) return kLonger * v;
  return arrow(v, transform);
}

Vec3 velocity(const Vec3& v, Transform transform) {
  return transform == Transform::boost ? v + kBoost : arrow(v, transform);
}

/// A spin is a pseudovector: the mirror turns round what lies in its plane.
Vec3 spin(const Vec3& w, Transform transform) {
  if (transform == Transform::mirror) return {-w.x, w.y, -w.z};
  if (transform == Transform::lengthen) return (1 / kLonger) * w;
  return arrow(w, transform);
}

Shape shape_of(const Shape& shape, Transform transform) {
  const double longer = transform == Transform::lengthen ? kLonger : 1;
  if (const auto* plane = std::get_if<Plane>(&shape))
    return Plane{place(plane->point, transform), arrow(plane->normal, transform)};
  if (const auto* plate = std::get_if<Plate>(&shape))
    return Plate{place(plate->centre, transform), arrow(plate->along, transform), arrow(plate->across, transform),
                 longer * plate->half_length, longer * plate->half_width};
  const Shell& shell = std::get<Shell>(shape);
  return Shell{place(shell.base, transform), longer * shell.base_radius, longer * shell.top_radius,
               longer * shell.height};
}

void lengthen(Impact& test) {
  const double k = kLonger;
  test.contact = enlarged(test.contact, k);
  test.contact.bridge.viscosity_pa_s *= k;  // a stress over a rate, and times grow
  test.reference_radius_m *= k;
  test.gravity_m_s2 /= k;
  test.duration_s *= k;
  test.step_s *= k;
  for (ImpactGrain& grain : test.grains) {
    grain.radius_m *= k;
    if (grain.turns_at_s) *grain.turns_at_s *= k;
  }
  for (ImpactWall& wall : test.walls) {
    wall.turning_rad_s /= k;
    if (wall.rotor_mass_kg) *wall.rotor_mass_kg *= k * k * k;
  }
}

Vec3 reading(const Outcome& outcome, std::size_t grain, const std::string& what, const std::string& unit) {
  const auto component = [&](const char* axis) {
    return outcome.readings.find("grain" + std::to_string(grain) + "." + what + "_" + axis + "_" + unit).value_or(0);
  };
  return {component("x"), component("y"), component("z")};
}

}  // namespace

Impact transformed(const Impact& test, Transform transform) {
  Impact seen = test;
  for (ImpactGrain& grain : seen.grains) {
    grain.centre_m = place(grain.centre_m, transform);
    grain.velocity_m_s = velocity(grain.velocity_m_s, transform);
    grain.spin_rad_s = spin(grain.spin_rad_s, transform);
  }
  for (ImpactWall& wall : seen.walls) {
    wall.shape = shape_of(wall.shape, transform);
    wall.velocity_m_s = velocity(wall.velocity_m_s, transform);
    wall.hinge_m = place(wall.hinge_m, transform);
  }
  if (transform == Transform::lengthen) lengthen(seen);
  return seen;
}

double difference(const Impact& test, const Outcome& before, Transform transform, const Outcome& after) {
  double largest = 0, off = 0;
  for (std::size_t i = 0; i < test.grains.size(); ++i) {
    const double radius = test.grains[i].radius_m;
    const Vec3 v = reading(before, i, "velocity", "m_s"), w = reading(before, i, "spin", "rad_s");
    const Vec3 v_after = reading(after, i, "velocity", "m_s"), w_after = reading(after, i, "spin", "rad_s");
    largest = std::max({largest, norm(v), radius * norm(w)});
    off = std::max({off, norm(v_after - velocity(v, transform)), radius * norm(w_after - spin(w, transform))});
  }
  return largest > 0 ? off / largest : off;
}

}  // namespace pastefit
