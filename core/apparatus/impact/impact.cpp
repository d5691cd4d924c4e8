#include "core/apparatus/impact/impact.h"

#include <algorithm>
#include <numbers>

#include "core/apparatus/impact/approach.h"
#include "core/apparatus/impact/swing.h"
#include "core/apparatus/rotor.h"
#include "core/laws/table.h"
#include "core/step/stepper.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

/// The step for `steps_per_contact`, such that the duration is a whole number of it. Speeds that only weight,
/// cohesion or a bridge will give count as well.
double constant_step(const Impact& test) {
  if (test.step == ImpactStep::fixed) return test.step_s;
  double shortest = test.duration_s;
  const auto consider = [&](const Approach& a, const PairConstants& pair) {
    const double attraction =
        test.contact.cohesion_n.value_or(attraction_at_touch(test.contact.bridge, test.reference_radius_m));
    const double depth = std::pow(0.75 * attraction / (a.modulus * std::sqrt(a.radius)), 2.0 / 3.0);
    const double way = depth + rupture_gap(test.contact.bridge, test.reference_radius_m);
    const double work = attraction * way + drawn_in(test.contact, pair, a.radius);
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

/// Where a held grain is at a time, and how fast.
struct Course {
  Vec3 position, velocity;
};
Course path(const ImpactGrain& grain, double time) {
  const double turn = grain.turns_at_s.value_or(1e300);
  const bool back = time > turn;
  return {grain.centre_m + (back ? 2 * turn - time : time) * grain.velocity_m_s,
          back ? -grain.velocity_m_s : grain.velocity_m_s};
}

/// The experiment in progress. Everything by the grains' places in the test, not in the world, which sorts them.
class ImpactRun {
 public:
  explicit ImpactRun(const Impact& test)
      : test_(test),
        n_(test.grains.size()),
        world_(make_world(test)),
        stepper_(world_, step_options(test)),
        now_(n_),
        held_force_(n_) {
    for (std::size_t i = 0; i < n_; ++i) mass_.push_back(mass_kg(test, test.grains[i]));
  }

  Outcome run(const RunOptions& options) {
    Outcome outcome;
    bool last = false;
    for (std::int64_t step = 0; !last; ++step) {
      last = (world_.time > test_.duration_s - 0.5 * stepper_.time_step() && step > 0) || rebound_is_over();
      const double most_s = std::max(0.0, test_.duration_s - world_.time);
      const Snapshot snapshot{"impact", world_.time, world_.step, &world_, 0, {0, most_s}};
      bool goes_on = !options.pulse || step % kStepsPerPulse != 0 || options.pulse(snapshot);
      if (options.watch && world_.time >= next_watch_) {
        next_watch_ = world_.time + options.watch_interval_s;
        goes_on = options.watch(snapshot) && goes_on;
      }
      if (!goes_on)
        outcome.failure = Failure{FailureReason::stopped, "", step, world_.time, -1, 0, 0, "the run was asked to stop"};
      if (!outcome.failure) outcome.failure = advance();
      if (step >= options.step_limit && !outcome.failure)
        outcome.failure = Failure{FailureReason::step_limit,
                                  "",
                                  step,
                                  world_.time,
                                  -1,
                                  static_cast<double>(step),
                                  static_cast<double>(options.step_limit),
                                  "the bound on the number of steps was reached; allow more or shorten the test"};
      if (outcome.failure) {
        outcome.failure->phase = "impact";
        break;
      }
      outcome.run.steps = step;
    }
    outcome.run.particles = static_cast<std::int64_t>(n_);
    outcome.run.particle_steps = outcome.run.particles * outcome.run.steps;
    outcome.run.simulated_s = last_time_;
    outcome.run.time_step_s = last_time_ / static_cast<double>(std::max<std::int64_t>(outcome.run.steps, 1));
    outcome.run.settled = true;
    if (!outcome.failure) read(outcome.observables);
    return outcome;
  }

 private:
  /// A grain at the moment to which the last forces belong.
  struct Sample {
    Vec3 position, velocity, spin;
    Vec3 force;  ///< all but its weight [N]
  };

  static StepOptions step_options(const Impact& test) {
    StepOptions options;
    if (test.step != ImpactStep::engine) options.fixed_step_s = constant_step(test);
    return options;
  }

  static World make_world(const Impact& test) {
    World world;
    std::vector<Vec3> centres;
    std::vector<double> radii;
    for (const ImpactGrain& grain : test.grains) {
      centres.push_back(grain.centre_m);
      radii.push_back(grain.radius_m);
    }
    world.particles = make_particles(centres, radii, test.density_kg_m3);
    for (std::size_t i = 0; i < test.grains.size(); ++i) {
      set_velocity(world.particles, static_cast<std::int32_t>(i), test.grains[i].velocity_m_s,
                   test.grains[i].spin_rad_s);
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

  /// One step; afterwards `now_` is what was at its beginning, when the forces acted.
  std::optional<Failure> advance() {
    const double step_before = stepper_.time_step(), time = world_.time;
    const double depth = watched_overlap();
    std::vector<Sample> before = states();
    const auto turn_rotors = [&](World&, double dt) { drive_rotors(0.5 * (step_before + dt), dt); };
    if (auto problem = stepper_.step(turn_rotors)) return problem;
    const double kick = 0.5 * (step_before + stepper_.time_step());
    const std::vector<Sample> after = states();
    const Vec3 weight{0, 0, -test_.gravity_m_s2};
    for (std::size_t i = 0; i < n_; ++i) {
      Sample& sample = before[i];
      sample.force = mass_[i] * ((1 / kick) * (after[i].velocity - sample.velocity) - weight);
      if (step_before > 0) {
        sample.velocity = 0.5 * (sample.velocity + after[i].velocity);
        sample.spin = 0.5 * (sample.spin + after[i].spin);
      }
    }
    account_momentum(before, kick);
    account_work(before);
    now_ = before;
    watch_first(time, depth);
    watch_rebound();
    watch_swing(time);
    if (first_) kinetic_at_start_ = kinetic_energy();
    first_ = false;
    hold();
    last_time_ = time;
    return {};
  }

  std::vector<Sample> states() const {
    std::vector<Sample> states(n_);
    const Particles& particles = world_.particles;
    for (std::int32_t i = 0; i < particles.count(); ++i)
      states[particles.identity[i]] = {
          particles.motion[i].position, particles.velocity[i].linear, particles.velocity[i].angular, {}};
    return states;
  }

  void drive_rotors(double kick, double dt) {
    for (std::size_t w = 0; w < test_.walls.size(); ++w) {
      if (!test_.walls[w].rotor_mass_kg || rotor_time_) continue;
      const Rotor plate{*test_.walls[w].rotor_mass_kg, rotor_inertia(test_.walls[w])};
      const auto landing = turn_freely(plate, world_.walls[w], world_.gravity, kick, dt);
      if (!landing) continue;
      rotor_time_ = world_.time + landing->after_s;
      rotor_speed_ = landing->turning_rad_s;
    }
    if (rotor_time_ && world_.time > *rotor_time_)
      for (std::size_t w = 0; w < test_.walls.size(); ++w)
        if (test_.walls[w].rotor_mass_kg) world_.walls[w].angular_velocity = {};
  }

  /// Puts the held grains where they are to be, whatever acted on them.
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

  double watched_overlap() {
    const std::vector<Sample> states = this->states();
    const double radius = test_.grains[0].radius_m;
    double deepest = -1e300;
    for (std::size_t j = 1; j < n_; ++j) {
      const Vec3 between = states[j].position - states[0].position;
      const double distance = norm(between), overlap = radius + test_.grains[j].radius_m - distance;
      if (overlap <= deepest) continue;
      deepest = overlap;
      towards_nearest_ = (1 / distance) * between;
    }
    for (const Wall& wall : world_.walls) {
      const Nearest point = nearest(wall.shape, states[0].position);
      if (radius - point.distance <= deepest) continue;
      deepest = radius - point.distance;
      towards_nearest_ = point.direction;
    }
    return deepest;
  }

  void watch_first(double time, double depth) {
    const double force = norm(now_[0].force), pull = dot(now_[0].force, towards_nearest_);
    max_force_ = std::max(max_force_, force);
    max_overlap_ = first_ ? depth : std::max(max_overlap_, depth);
    if (!first_) {
      const double interval = time - last_time_;
      const double inside = std::max(depth, 0.0) + std::max(overlap_, 0.0), spanned = std::fabs(depth - overlap_);
      // Share of the interval in which the overlap, a straight line, was positive.
      if (depth > 0 && overlap_ > 0)
        contact_time_ += interval;
      else if (inside > 0)
        contact_time_ += interval * inside / spanned;
      for (std::size_t k = 0; k < test_.pull_gaps_m.size(); ++k) {
        const double from_start = -test_.pull_gaps_m[k] - overlap_, step = depth - overlap_;
        if (step == 0 || from_start / step < 0 || from_start / step > 1) continue;
        pulls_[k] = pull_ + from_start / step * (pull - pull_);
      }
    } else {
      pulls_.assign(test_.pull_gaps_m.size(), std::nullopt);
    }
    overlap_ = depth;
    pull_ = pull;
  }

  void watch_rebound() {
    if (overlap_ <= 0 && !top_) return;
    top_ = std::max(top_.value_or(now_[0].position.z), now_[0].position.z);
    const bool recedes = dot(now_[0].velocity, towards_nearest_) < 0;
    came_back_ = came_back_ || (receded_ && !recedes);
    receded_ = receded_ || recedes;
  }

  bool rebound_is_over() const {
    return test_.rebound_gap_m && top_ && (came_back_ || -overlap_ > *test_.rebound_gap_m);
  }

  void watch_swing(double time) {
    const ImpactGrain& grain = test_.grains[0];
    swing_.add(time, dot(now_[0].position - grain.centre_m, grain.velocity_m_s));
  }

  void account_momentum(const std::vector<Sample>& samples, double kick) {
    Vec3 change, given;
    double size = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      change += kick * samples[i].force;
      size += mass_[i] * norm(samples[i].velocity);
    }
    for (const Wall& wall : world_.walls) given += -(kick * wall.force);
    unexplained_ += change - given;
    momentum_size_ = std::max(momentum_size_, size);
  }

  void account_work(const std::vector<Sample>& samples) {
    for (std::size_t i = 0; i < n_; ++i) {
      if (!test_.grains[i].held) continue;
      if (!first_) work_ -= 0.5 * dot(held_force_[i] + samples[i].force, samples[i].position - now_[i].position);
      held_force_[i] = samples[i].force;
    }
  }

  double kinetic_energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double r = test_.grains[i].radius_m;
      const Vec3 &v = now_[i].velocity, &w = now_[i].spin;
      sum += mass_[i] * (0.5 * dot(v, v) + 0.2 * r * r * dot(w, w));
    }
    return sum;
  }

  void read(Observables& readings) const {
    const auto set = [&](std::size_t i, const char* what, const char* unit, const Vec3& v) {
      const std::string name = "grain" + std::to_string(i) + "." + what;
      readings.set(name + "_x_" + unit, v.x);
      readings.set(name + "_y_" + unit, v.y);
      readings.set(name + "_z_" + unit, v.z);
    };
    for (std::size_t i = 0; i < n_; ++i) {
      set(i, "position", "m", now_[i].position);
      set(i, "velocity", "m_s", now_[i].velocity);
      set(i, "spin", "rad_s", now_[i].spin);
      readings.set("grain" + std::to_string(i) + ".speed_m_s", norm(now_[i].velocity));
    }
    if (n_ > 1) readings.set("relative_speed_m_s", norm(now_[0].velocity - now_[1].velocity));
    readings.set("overlap_m", overlap_);
    readings.set("max_overlap_m", max_overlap_);
    readings.set("max_force_n", max_force_);
    readings.set("contact_time_s", contact_time_);
    for (std::size_t k = 0; k < pulls_.size(); ++k)
      if (pulls_[k]) readings.set("pull" + std::to_string(k) + "_n", *pulls_[k]);
    if (kinetic_at_start_ > 0) readings.set("kinetic_energy_ratio", kinetic_energy() / kinetic_at_start_);
    if (momentum_size_ > 0) readings.set("momentum_drift", norm(unexplained_) / momentum_size_);
    if (const auto rate = swing_.decay_rate()) readings.set("decay_rate_1_s", *rate);
    if (top_) readings.set("rebound_top_m", *top_);
    readings.set("work_j", work_);
    readings.set("time_s", last_time_);
    if (!rotor_time_) return;
    readings.set("rotor_time_s", *rotor_time_);
    readings.set("rotor_rad_s", rotor_speed_);
  }

  const Impact& test_;
  const std::size_t n_;
  World world_;
  Stepper stepper_;
  std::vector<double> mass_;
  std::vector<Sample> now_;
  double last_time_ = 0;  ///< of `now_`
  double next_watch_ = 0;
  bool first_ = true;

  Vec3 towards_nearest_;
  double overlap_ = 0, pull_ = 0, max_overlap_ = 0, max_force_ = 0, contact_time_ = 0;
  std::vector<std::optional<double>> pulls_;
  std::optional<double> top_;  ///< of the first grain since it touched [m]
  bool receded_ = false, came_back_ = false;
  double kinetic_at_start_ = 0;
  Vec3 unexplained_;
  double momentum_size_ = 0;
  std::vector<Vec3> held_force_;
  double work_ = 0;
  Swing swing_;
  std::optional<double> rotor_time_;
  double rotor_speed_ = 0;
};

}  // namespace

double mass_kg(const Impact& test, const ImpactGrain& grain) {
  return 4.0 / 3.0 * std::numbers::pi * std::pow(grain.radius_m, 3) * test.density_kg_m3;
}

Outcome simulate(const Impact& test, const RunOptions& options) {
  return ImpactRun(test).run(options);
}

}  // namespace pastefit
