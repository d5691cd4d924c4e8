#include <algorithm>
#include <cmath>

#include "core/step/stepper.h"
#include "core/world/nearest.h"

// The energies in the balance of a step.

namespace pastefit {

namespace {

/// Elastic energy in the overlaps of all contacts [J].
double elastic_energy(const World& world) {
  const auto held = [&](const PairConstants& pair, double sqrt_radius, double overlap) {
    return with_law(NormalLaws{}, acting(world.normal, pair), [&](auto law) {
      const NormalForce<double> normal_force = law.at(pair, sqrt_radius, std::max(overlap, 0.0), 0.0);
      double energy = law.energy(pair, sqrt_radius * sqrt_radius, normal_force, overlap);
      if constexpr (law.adheres) energy += law.surface(pair, sqrt_radius * sqrt_radius, normal_force.contact_radius);
      return energy;
    });
  };
  double sum = 0;
  for (const Block& block : world.pairs.blocks)
    for (std::int32_t k = 0; k < block.contacts.count; ++k) {
      const std::int32_t i = block.contacts.first(k), j = block.contacts.second(k);
      if (i == j) continue;  // padding
      const Motion &a = world.particles.motion[i], &b = world.particles.motion[j];
      const double overlap = a.radius + b.radius - norm(world.domain.minimum_image(a.position, b.position));
      sum += held(world.grain_pair, block.contacts.sqrt_radius(k), overlap);
    }
  for (const Block& block : world.pairs.blocks)
    for (std::size_t w = 0; w < block.walls.size(); ++w)
      for (std::int32_t k = 0; k < block.walls[w].count; ++k) {
        const Motion& grain = world.particles.motion[block.walls[w].contacts.first(k)];
        const double overlap = grain.radius - nearest(world.walls[w].shape, grain.position).distance;
        sum += held(world.walls[w].pair, block.walls[w].contacts.sqrt_radius(k), overlap);
      }
  return sum;
}

}  // namespace

/// Energies at the time of the positions: velocities are the means of the half steps around it.
void Stepper::look_at_energy(double dt) {
  const Particles& particles = world_.particles;
  const double half_kick = 0.25 * (dt_ + dt);
  if (!looks_at_energy()) return;
  energy_balance_.kinetic = energy_balance_.height = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Motion& motion = particles.motion[i];
    const Load& load = particles.load[i];
    const Velocity& velocity = particles.velocity[i];
    const double m = 1 / velocity.inverse_mass, inertia = 1 / velocity.inverse_inertia;
    Vec3 v = velocity.linear + (half_kick / m) * vector_of(load.force);
    v.z -= half_kick * world_.gravity;
    const Vec3 w = velocity.angular + (half_kick / inertia) * vector_of(load.torque);
    energy_balance_.kinetic += 0.5 * (m * dot(v, v) + inertia * dot(w, w));
    energy_balance_.height += m * world_.gravity * motion.position.z;
  }
  energy_balance_.stored = total(energy_, EnergySums::stored);
  energy_balance_.dissipation_normal = total(energy_, EnergySums::normal_damping);
  energy_balance_.dissipation_sliding = total(energy_, EnergySums::sliding);
  energy_balance_.dissipation_rolling = total(energy_, EnergySums::rolling);
  energy_balance_.dissipation_bridges = total(energy_, EnergySums::bridges);
  energy_balance_.dissipation_viscous = total(energy_, EnergySums::viscous);
  energy_balance_.dissipation_plastic = total(energy_, EnergySums::plastic);
  if (looked_) return;
  looked_ = true;
  energy_balance_.start = energy_balance_.mechanical() + energy_balance_.dissipation() - energy_balance_.work_of_walls;
  energy_balance_.start_height = energy_balance_.height;
  if (energy_balance_.earlier_put_in > 0) return;
  energy_balance_.start_kinetic = energy_balance_.kinetic;
  energy_balance_.start_elastic = elastic_energy(world_);
}

void Stepper::follow(const EnergyBalance& before) {
  energy_balance_.earlier_error = before.error();
  energy_balance_.earlier_put_in = before.put_in();
}

}  // namespace pastefit
