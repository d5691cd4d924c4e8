#include "core/apparatus/impact/approach.h"

#include <cmath>

#include "core/laws/table.h"

namespace pastefit {

namespace {

double effective_modulus(double e1, double nu1, double e2, double nu2) {
  return 1 / ((1 - nu1 * nu1) / e1 + (1 - nu2 * nu2) / e2);
}

Vec3 velocity_at(const ImpactWall& wall, const Vec3& point) {
  return wall.velocity_m_s + cross(Vec3{0, wall.turning_rad_s, 0}, point - wall.hinge_m);
}

}  // namespace

Approach approach_of_grains(const Impact& test, std::size_t i, std::size_t j) {
  const ImpactGrain &a = test.grains[i], &b = test.grains[j];
  const ContactModel& model = test.contact;
  const Vec3 between = b.centre_m - a.centre_m;
  Approach approach;
  approach.normal = (1 / norm(between)) * between;
  approach.velocity =
      a.velocity_m_s - b.velocity_m_s + cross(a.radius_m * a.spin_rad_s + b.radius_m * b.spin_rad_s, approach.normal);
  approach.speed = dot(approach.velocity, approach.normal);
  approach.radius = a.radius_m * b.radius_m / (a.radius_m + b.radius_m);
  const double ma = mass_kg(test, a), mb = mass_kg(test, b);
  approach.mass = ma * mb / (ma + mb);
  approach.modulus =
      effective_modulus(model.youngs_modulus_pa, model.poissons_ratio, model.youngs_modulus_pa, model.poissons_ratio);
  approach.friction = model.friction;
  approach.restitution = model.restitution;
  return approach;
}

Approach approach_of_wall(const Impact& test, std::size_t i, std::size_t w) {
  const ImpactGrain& grain = test.grains[i];
  const ImpactWall& wall = test.walls[w];
  const Nearest point = nearest(wall.shape, grain.centre_m);
  const Vec3 place = grain.centre_m + point.distance * point.direction;
  Approach approach;
  approach.normal = point.direction;
  approach.velocity =
      grain.velocity_m_s - velocity_at(wall, place) + cross(grain.radius_m * grain.spin_rad_s, approach.normal);
  approach.speed = dot(approach.velocity, approach.normal);
  approach.radius = grain.radius_m;
  approach.mass = mass_kg(test, grain);
  if (wall.rotor_mass_kg) {
    const double lever = cross(place - wall.hinge_m, approach.normal).y;
    approach.mass = 1 / (1 / approach.mass + lever * lever / rotor_inertia(wall));
  }
  approach.modulus = effective_modulus(test.contact.youngs_modulus_pa, test.contact.poissons_ratio,
                                       wall.surface.youngs_modulus_pa, wall.surface.poissons_ratio);
  approach.friction = wall.surface.friction;
  approach.restitution = wall.surface.restitution;
  return approach;
}

// 4 sqrt(pi) Gamma(2/5)/(5 Gamma(9/10)) (15/16)^(2/5): the contact lasts 2.943 times the largest overlap over the
// speed.
constexpr double kHertzDuration = 2.8682656992;

double hertz_contact_time(const Approach& a, double speed) {
  return kHertzDuration * std::pow(a.mass * a.mass / (a.radius * a.modulus * a.modulus * speed), 0.2);
}

double drawn_in(const ContactModel& model, const PairConstants& pair, double radius) {
  return with_law(NormalLaws{}, acting(model.normal, pair), [&](auto normal) {
    const double rest = normal.overlap_under(pair, radius, 0);
    const double held = normal.energy(pair, radius, normal.at(pair, std::sqrt(radius), rest, 0.0), rest);
    if constexpr (normal.reaches) return -normal.spent(pair, radius) - held;
    return -held;
  });
}

double rotor_inertia(const ImpactWall& wall) {
  const Plate& plate = std::get<Plate>(wall.shape);
  const Vec3 arm = plate.centre - wall.hinge_m;
  return *wall.rotor_mass_kg * (plate.half_length * plate.half_length / 3 + arm.x * arm.x + arm.z * arm.z);
}

}  // namespace pastefit
