#include "core/world/particles.h"

#include <cassert>
#include <numbers>

namespace pastefit {

namespace {

constexpr double kFarAway = 1e6;  // [m]; dummies are never near a grain

template <class T>
void permute(std::vector<T>& values, const std::vector<std::int32_t>& order) {
  const std::vector<T> before(values);
  for (std::size_t k = 0; k < order.size(); ++k) values[k] = before[order[k]];
}

}  // namespace

Particles make_particles(const std::vector<Vec3>& centres, const std::vector<double>& radii, double density_kg_m3) {
  assert(centres.size() == radii.size());
  Particles particles;
  particles.density_kg_m3 = density_kg_m3;
  const std::size_t n = centres.size();
  particles.motion.resize(n + 1);
  particles.velocity.resize(n + 1);
  particles.load.resize(n + 1);
  particles.identity.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double r = radii[i];
    const double lightness = 1 / (4.0 / 3.0 * std::numbers::pi * r * r * r * density_kg_m3);
    particles.motion[i].position = centres[i];
    particles.motion[i].radius = r;
    particles.motion[i].rounded_radius = static_cast<float>(r);
    particles.velocity[i] = {{}, lightness, {}, 2.5 * lightness / (r * r)};
    particles.identity[i] = static_cast<std::int32_t>(i);
  }
  particles.motion[n].position = {kFarAway, kFarAway, kFarAway};
  return particles;
}

void set_velocity(Particles& particles, std::int32_t i, const Vec3& linear, const Vec3& angular) {
  Motion& motion = particles.motion[i];
  particles.velocity[i].linear = linear;
  particles.velocity[i].angular = angular;
  put_rounded(linear, motion.velocity);
  put_rounded(angular, motion.spin);
}

void provide_dummies(Particles& particles, std::size_t count) {
  const std::size_t n = particles.identity.size();
  Motion dummy;
  dummy.position = {kFarAway, kFarAway, kFarAway};
  particles.motion.resize(n + count, dummy);
  particles.velocity.resize(n + count);
  particles.load.resize(n + count);
}

void reorder(Particles& particles, const std::vector<std::int32_t>& order) {
  permute(particles.motion, order);
  permute(particles.velocity, order);
  permute(particles.load, order);
  permute(particles.identity, order);
}

}  // namespace pastefit
