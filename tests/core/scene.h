#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/step/stepper.h"
#include "core/world/world.h"

namespace pastefit {

/// A few bodies for tests of contacts, in the words of the tests.
class Scene {
 public:
  World world;
  StepOptions options;

  explicit Scene(const ContactModel& model, double radius = 0.01, double density = 2500) : density_(density) {
    set_contact_model(world, model, radius);
    world.gravity = 0;
    model_ = model;
    radius_ = radius;
  }

  Scene& grain(Vec3 centre, Vec3 velocity = {}, Vec3 spin = {}) { return grain_of(radius_, centre, velocity, spin); }

  Scene& grain_of(double radius, Vec3 centre, Vec3 velocity = {}, Vec3 spin = {}) {
    centres_.push_back(centre);
    radii_.push_back(radius);
    velocities_.push_back(velocity);
    spins_.push_back(spin);
    return *this;
  }

  Scene& wall(const Shape& shape, const WallContact& surface) {
    Wall wall;
    wall.shape = shape;
    wall.pair = wall_pair(model_, surface, radius_);
    world.walls.push_back(wall);
    return *this;
  }

  /// Steps of `dt` for `duration`, with the step as asked and nothing else. Another step starts the leapfrog anew, from
  /// the velocities as they are.
  void run(double duration, double dt) {
    ready();
    if (options.fixed_step_s != dt) stepper_.reset();
    options.fixed_step_s = dt;
    if (!stepper_) stepper_ = std::make_unique<Stepper>(world, options);
    const auto steps = static_cast<long>(std::lround(duration / dt));
    for (long n = 0; n < steps; ++n) problem = stepper_->step({});
  }

  /// The step follows from the scene.
  void run_by_itself(double duration) {
    ready();
    options.fixed_step_s.reset();
    stepper_ = std::make_unique<Stepper>(world, options);
    while (world.time < duration) problem = stepper_->step({});
  }

  const EnergyBalance& energy_balance() const { return stepper_->energy_balance(); }
  double time_step() const { return stepper_->time_step(); }

  /// Grain by the order in which it was added.
  const Motion& motion(int identity) const { return world.particles.motion[place(identity)]; }
  const Vec3& velocity(int identity) const { return world.particles.velocity[place(identity)].linear; }
  const Vec3& spin(int identity) const { return world.particles.velocity[place(identity)].angular; }
  double mass(int identity) const { return world.particles.mass(place(identity)); }

  Vec3 momentum() const {
    Vec3 sum;
    for (int i = 0; i < world.particles.count(); ++i)
      sum += world.particles.mass(i) * world.particles.velocity[i].linear;
    return sum;
  }

  double kinetic_energy() const {
    double sum = 0;
    for (int i = 0; i < world.particles.count(); ++i) {
      const double m = world.particles.mass(i), r = world.particles.motion[i].radius;
      const Vec3 &v = world.particles.velocity[i].linear, &w = world.particles.velocity[i].angular;
      sum += 0.5 * m * dot(v, v) + 0.2 * m * r * r * dot(w, w);
    }
    return sum;
  }

  std::optional<Failure> problem;

 private:
  void ready() {
    if (world.particles.count() > 0) return;
    world.particles = make_particles(centres_, radii_, density_);
    for (std::int32_t i = 0; i < world.particles.count(); ++i)
      set_velocity(world.particles, i, velocities_[i], spins_[i]);
  }
  int place(int identity) const {
    for (int i = 0; i < world.particles.count(); ++i)
      if (world.particles.identity[i] == identity) return i;
    return -1;
  }

  ContactModel model_;
  double radius_ = 0, density_ = 0;
  std::vector<Vec3> centres_, velocities_, spins_;
  std::vector<double> radii_;
  std::unique_ptr<Stepper> stepper_;
};

}  // namespace pastefit
