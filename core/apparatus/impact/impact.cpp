#include "core/apparatus/impact/impact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/apparatus/drive.h"
#include "core/apparatus/impact/approach.h"
#include "core/apparatus/impact/impact_record.h"
#include "core/laws/table.h"
#include "core/step/runner.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

/// The step for `steps_per_contact`, rounded so that the duration is a whole number of steps. Includes speeds that
/// gravity, cohesion or a bridge will cause.
double constant_step(const Impact& test) {
  if (test.step == ImpactStep::fixed) return test.step_s;
  double shortest = test.duration_s;
  const auto consider = [&](const Approach& a, const PairConstants& pair) {
    const double attraction =
        test.contact.cohesion_n.value_or(attraction_at_touch(test.contact.bridge, test.reference_radius_m));
    const double depth = std::pow(0.75 * attraction / (a.modulus * std::sqrt(a.radius)), 2.0 / 3.0);
    const double distance = depth + rupture_gap(test.contact.bridge, test.reference_radius_m);
    const double work = attraction * distance + drawn_in(test.contact, pair, a.radius);
    const double drawn = std::sqrt(2 * work / a.mass + test.gravity_m_s2 * a.radius);
    const double speed = norm(a.velocity) + drawn;
    if (speed > 0) shortest = std::min(shortest, hertz_contact_time(a, speed));
  };
  for (std::size_t i = 0; i < test.grains.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      consider(approach_of_grains(test, i, j), grain_pair(test.contact, test.reference_radius_m));
    for (std::size_t w = 0; w < test.walls.size(); ++w)
      consider(approach_of_wall(test, i, w), wall_pair(test.contact, test.walls[w].surface, test.reference_radius_m));
  }
  return test.duration_s / std::ceil(test.duration_s * test.steps_per_contact / shortest);
}

/// Position and velocity of a held grain at a given time.
struct Course {
  Vec3 position, velocity;
};
Course path(const ImpactGrain& grain, double time) {
  const double turn = grain.turns_at_s.value_or(1e300);
  const bool back = time > turn;
  return {grain.centre_m + (back ? 2 * turn - time : time) * grain.velocity_m_s,
          back ? -grain.velocity_m_s : grain.velocity_m_s};
}

World make_world(const Impact& test) {
  World world;
  std::vector<Vec3> centres;
  std::vector<double> radii;
  for (const ImpactGrain& grain : test.grains) {
    centres.push_back(grain.centre_m);
    radii.push_back(grain.radius_m);
  }
  world.particles = make_particles(centres, radii, test.density_kg_m3);
  for (std::size_t i = 0; i < test.grains.size(); ++i) {
    set_velocity(world.particles, static_cast<std::int32_t>(i), test.grains[i].velocity_m_s, test.grains[i].spin_rad_s);
  }
  set_contact_model(world, test.contact, test.reference_radius_m);
  world.gravity = test.gravity_m_s2;
  for (const ImpactWall& of_test : test.walls) {
    Wall wall;
    wall.shape = of_test.shape;
    wall.pair = wall_pair(test.contact, of_test.surface, test.reference_radius_m);
    wall.velocity = of_test.velocity_m_s;
    wall.angular_velocity = {0, of_test.turning_rad_s, 0};
    wall.pivot = of_test.hinge_m;
    world.walls.push_back(wall);
  }
  return world;
}

/// Run options: the test's own step, and no energy balance, which would not include the work of held grains.
RunOptions options_of(const Impact& test, RunOptions options) {
  options.steps = {};
  options.steps.energy_balance = false;
  if (test.step != ImpactStep::engine) options.steps.fixed_step_s = constant_step(test);
  options.checkpoint = nullptr;
  return options;
}

/// The experiment in progress.
class ImpactRun {
 public:
  ImpactRun(const Impact& test, const RunOptions& options)
      : test_(test),
        options_(options_of(test, options)),
        world_(make_world(test)),
        runner_(world_, options_, {}),
        record_(test, world_) {}

  /// Runs until the duration is over, within half a step, and one more step, which gives the velocities at that moment.
  Outcome run() {
    const auto drive = [this](World&, double dt) { drive_rotors(dt); };
    const auto is_over = [this](const World&) {
      end_step();
      return world_.time > test_.duration_s - 0.5 * dt_ || record_.rebound_is_over();
    };
    const Phase phase{"impact", drive, is_over};
    Outcome outcome;
    record_.begin_step();
    outcome.failure = runner_.run(phase, test_.duration_s);
    if (!outcome.failure) outcome.failure = runner_.run(phase, 0.5 * dt_);
    outcome.run = runner_.summary();
    if (outcome.failure) return outcome;
    record_.read(outcome.readings);
    if (!rotor_time_) return outcome;
    outcome.readings.set("rotor_time_s", *rotor_time_);
    outcome.readings.set("rotor_rad_s", rotor_speed_);
    return outcome;
  }

 private:
  void end_step() {
    record_.end_step(kick_);
    hold();
    record_.begin_step();
  }

  void drive_rotors(double dt) {
    kick_ = 0.5 * (dt_ + dt);
    dt_ = dt;
    for (std::size_t w = 0; w < test_.walls.size(); ++w) {
      if (!test_.walls[w].rotor_mass_kg || rotor_time_) continue;
      const Rotor plate{*test_.walls[w].rotor_mass_kg, rotor_inertia(test_.walls[w])};
      const auto landing = turn_freely(plate, world_.walls[w], world_.gravity, kick_, dt);
      if (!landing) continue;
      rotor_time_ = world_.time + landing->after_s;
      rotor_speed_ = landing->turning_rad_s;
    }
    if (rotor_time_ && world_.time > *rotor_time_)
      for (std::size_t w = 0; w < test_.walls.size(); ++w)
        if (test_.walls[w].rotor_mass_kg) world_.walls[w].angular_velocity = {};
  }

  /// Puts the held grains on their prescribed paths, whatever the forces.
  void hold() {
    Particles& particles = world_.particles;
    for (std::int32_t i = 0; i < particles.count(); ++i) {
      const ImpactGrain& grain = test_.grains[particles.identity[i]];
      if (!grain.held) continue;
      const auto [position, velocity] = path(grain, world_.time);
      particles.motion[i].position = position;
      set_velocity(particles, i, velocity, {});
    }
  }

  const Impact& test_;
  const RunOptions options_;
  World world_;
  Runner runner_;
  ImpactRecord record_;
  double dt_ = 0;    ///< the last step [s]
  double kick_ = 0;  ///< time over which the last step changed the velocities [s]
  std::optional<double> rotor_time_;
  double rotor_speed_ = 0;
};

}  // namespace

double mass_kg(const Impact& test, const ImpactGrain& grain) {
  return 4.0 / 3.0 * std::numbers::pi * std::pow(grain.radius_m, 3) * test.density_kg_m3;
}

Outcome simulate(const Impact& test, const RunOptions& options) {
  return ImpactRun(test, options).run();
}

}  // namespace pastefit
