#include "core/step/stepper.h"

#include <algorithm>
#include <cmath>

namespace pastefit {

namespace {

constexpr double kStepsPerSelection = 12;  // selections are a tenth of the work of a step; see README
constexpr double kSmallestLeeway = 0.005;  // of the mean radius
constexpr double kLargestLeeway = 0.1;
constexpr double kSmallestShare = 1e-4;  // of the first step; a healthy run stays within a factor of ten
constexpr double kRunawaySpeed = 100;    // [m/s]; nothing in a laboratory test comes near it

ContactView view(Contacts& c) {
  ContactView v{};
  v.i = c.i.data();
  v.j = c.j.data();
  v.root_radius = c.root_radius.data();
  v.root_mass = c.root_mass.data();
  v.inverse_mass = c.inverse_mass.data();
  v.size_scale = c.size_scale.data();
  for (int k = 0; k < 3; ++k) {
    v.slip[k] = c.slip[k].data();
    v.roll[k] = c.roll[k].data();
  }
  v.root_contact_radius = c.root_contact_radius.data();
  v.damper = c.damper.data();
  v.drag = c.drag.data();
  v.bridge = c.bridge.data();
  v.count = c.padded();
  return v;
}

ContactView view(Bridges& b) {
  ContactView v{};
  v.i = b.i.data();
  v.j = b.j.data();
  v.size_scale = b.size_scale.data();
  v.bridge = b.bridge.data();
  v.count = b.padded();
  return v;
}

double speed_of(const Wall& wall) {
  // The farthest point of a turning wall is not known here; walls that turn are plates of at most a few metres.
  double reach = 0;
  if (const auto* plate = std::get_if<Plate>(&wall.shape))
    reach = norm(plate->centre - wall.pivot) + plate->half_length + plate->half_width;
  return norm(wall.velocity) + norm(wall.angular_velocity) * reach;
}

/// What the normal springs of all contacts hold [J].
double elastic_energy(const World& world) {
  const auto spring = [](const PairConstants& pair, double root_radius, double overlap) {
    return 0.4 * pair.hertz * root_radius * std::pow(std::max(overlap, 0.0), 2.5);
  };
  double sum = 0;
  const Contacts& contacts = world.acting.contacts;
  for (std::int32_t k = 0; k < contacts.count; ++k) {
    const Motion &a = world.particles.motion[contacts.i[k]], &b = world.particles.motion[contacts.j[k]];
    sum += spring(world.grain_pair, contacts.root_radius[k], a.radius + b.radius - norm(b.position - a.position));
  }
  for (const Wall& wall : world.walls)
    for (std::int32_t k = 0; k < wall.touching.contacts.count; ++k)
      sum += spring(wall.pair, wall.touching.contacts.root_radius[k], wall.touching.overlap[k]);
  return sum;
}

}  // namespace

Stepper::Stepper(World& world, const StepOptions& options)
    : world_(world), options_(options), kernels_(options.kernels ? *options.kernels : kernels_of_this_processor()) {
  smallest_radius_ = smallest_mass_ = 1e300;
  for (std::int32_t i = 0; i < world.particles.count(); ++i) {
    smallest_radius_ = std::min(smallest_radius_, world.particles.motion[i].radius);
    smallest_mass_ = std::min(smallest_mass_, world.particles.mass(i));
    fastest_ = std::max(fastest_, norm(world.particles.motion[i].velocity));
  }
}

std::optional<Failure> Stepper::step(const std::function<void(World&, double)>& drive) {
  if (auto problem = maintain_lists()) return problem;
  compute_forces();
  if (pierced_ >= 0)
    return failure(
        FailureReason::grain_lost, world_.particles.identity[pierced_], options_.overlap_limit, options_.overlap_limit,
        "a grain is pressed into a wall by more than the allowed share of its radius; take stiffer grains or a "
        "smaller step");
  const double advised = time_step_.next(advised_step(world_, {smallest_radius_, smallest_mass_, fastest_}, options_));
  const double dt = options_.fixed_step_s.value_or(advised);
  if (dt < kSmallestShare * time_step_.first() && !options_.fixed_step_s)
    return failure(FailureReason::step_collapse, -1, dt, kSmallestShare * time_step_.first(),
                   "the stable time step shrinks without end; take softer grains, less cohesion or a slower lift");
  if (drive) drive(world_, dt);
  account_walls(dt);
  look_at_energy(dt);
  integrate(dt);
  for (Wall& wall : world_.walls) move(wall, dt);
  world_.time += dt;
  ++world_.step;
  dt_ = dt;
  return {};
}

std::optional<Failure> Stepper::maintain_lists() {
  double fastest_wall = 0;
  for (const Wall& wall : world_.walls) fastest_wall = std::max(fastest_wall, speed_of(wall));
  wall_moved_ += fastest_wall * dt_;
  if (runaway_ >= 0) {
    const double speed = norm(world_.particles.motion[runaway_].velocity);
    const bool finite = std::isfinite(speed);
    return failure(finite ? FailureReason::runaway_speed : FailureReason::non_finite,
                   world_.particles.identity[runaway_], finite ? speed : 0, kRunawaySpeed,
                   finite
                       ? "a grain is faster than anything in the test can make it; take a smaller step or less stiff "
                         "or less cohesive grains"
                       : "a velocity is not a number; take a smaller step");
  }
  if (lists_valid_ && !strayed_ && wall_moved_ <= wall_leeway_) return {};

  Particles& particles = world_.particles;
  const double radius = world_.reference_radius;
  const double skin = options_.skin * radius;
  if (lists_valid_) {
    double farthest = 0;
    for (std::int32_t i = 0; i < particles.count(); ++i) {
      const Vec3 shift = particles.motion[i].position - listed_position_[i];
      farthest = std::max(farthest, dot(shift, shift));
    }
    lists_valid_ = 2 * std::sqrt(farthest) <= skin - 2 * kLargestLeeway * radius;
  }
  if (!lists_valid_) {
    const std::vector<std::int32_t> new_place =
        rebuild(particles, world_.acting, world_.candidates, world_.reach(), skin);
    for (Wall& wall : world_.walls) renumber(wall, new_place);
    listed_position_.resize(particles.count());
    for (std::int32_t i = 0; i < particles.count(); ++i) listed_position_[i] = particles.motion[i].position;
    lists_valid_ = true;
  }
  const double duration = dt_ * kStepsPerSelection;
  set_leeway(particles, world_.candidates, duration, kSmallestLeeway * radius, kLargestLeeway * radius, leeway_);
  wall_leeway_ = std::clamp(fastest_wall * duration, kSmallestLeeway * radius, kLargestLeeway * radius);
  const Deepest deepest =
      select_interactions(particles, world_.candidates, world_.acting, scratch_, world_.reach(), leeway_);
  for (Wall& wall : world_.walls) select_contacts(particles, wall, world_.reach(), leeway_, wall_leeway_);
  strayed_ = false;
  wall_moved_ = 0;
  if (deepest.overlap > options_.overlap_limit)
    return failure(FailureReason::excessive_overlap, particles.identity[deepest.grain], deepest.overlap,
                   options_.overlap_limit,
                   "two grains overlap by more than the allowed share of a radius; stiffer grains or less cohesion");
  return {};
}

void Stepper::compute_forces() {
  const int attraction = attraction_index(world_.attraction), rolling = rolling_index(world_.rolling);
  std::fill(std::begin(energy_.lane[EnergySums::stored]), std::end(energy_.lane[EnergySums::stored]), 0.0);
  KernelTask task{};
  task.energy = &energy_;
  task.with_stored = world_.step % kLedgerInterval == 0;
  task.motion = world_.particles.motion.data();
  task.spin = world_.particles.spin.data();
  task.load = world_.particles.load.data();
  task.contacts = view(world_.acting.contacts);
  task.pair = world_.grain_pair;
  task.dt = dt_;
  kernels_.pair[attraction][rolling](task);
  if (world_.acting.bridges.count > 0) {
    task.contacts = view(world_.acting.bridges);
    kernels_.bridge[attraction](task);
  }
  for (Wall& wall : world_.walls) act_on_wall(wall);
}

void Stepper::act_on_wall(Wall& wall) {
  WallContacts& touching = wall.touching;
  const std::int32_t n = touching.contacts.count;
  wall.force = wall.torque = {};
  if (n == 0) return;
  Particles& particles = world_.particles;
  for (std::int32_t k = 0; k < n; ++k) {
    const Motion& grain = particles.motion[touching.contacts.i[k]];
    const Nearest point = nearest(wall.shape, grain.position);
    touching.normal[0][k] = point.direction.x;
    touching.normal[1][k] = point.direction.y;
    touching.normal[2][k] = point.direction.z;
    touching.overlap[k] = grain.radius - point.distance;
    if (touching.overlap[k] > options_.overlap_limit * grain.radius) pierced_ = touching.contacts.i[k];
    const Vec3 arm = grain.position + point.distance * point.direction - wall.pivot;
    const Vec3 velocity = wall.velocity_before + cross(wall.angular_velocity_before, arm);
    touching.wall_velocity[0][k] = velocity.x;
    touching.wall_velocity[1][k] = velocity.y;
    touching.wall_velocity[2][k] = velocity.z;
  }

  KernelTask task{};
  task.energy = &energy_;
  task.with_stored = world_.step % kLedgerInterval == 0;
  task.motion = particles.motion.data();
  task.spin = particles.spin.data();
  task.contacts = view(touching.contacts);
  for (int c = 0; c < 3; ++c) {
    task.wall.normal[c] = touching.normal[c].data();
    task.wall.wall_velocity[c] = touching.wall_velocity[c].data();
    task.wall.force[c] = touching.force[c].data();
    task.wall.moment[c] = touching.moment[c].data();
  }
  task.wall.overlap = touching.overlap.data();
  task.wall.damping = touching.damping.data();
  task.wall.stiffness = touching.stiffness.data();
  task.pair = wall.pair;
  task.dt = dt_;
  const BridgeShape attraction = wall.pair.bridge_c > 0 ? world_.attraction : BridgeShape::none;
  kernels_.wall[attraction_index(attraction)][rolling_index(world_.rolling)](task);

  for (std::int32_t k = 0; k < n; ++k) {
    const std::int32_t i = touching.contacts.i[k];
    Load& load = particles.load[i];
    const Vec3 force{touching.force[0][k], touching.force[1][k], touching.force[2][k]};
    load.force += force;
    load.torque += Vec3{touching.moment[0][k], touching.moment[1][k], touching.moment[2][k]};
    load.damping += touching.damping[k];
    // A wall does not give way: half of what two equal grains would count in the bound 2 sum(k)/m.
    load.stiffness += 0.5 * touching.stiffness[k];
    wall.force += -force;
    const Motion& grain = particles.motion[i];
    const Vec3 normal{touching.normal[0][k], touching.normal[1][k], touching.normal[2][k]};
    const Vec3 arm = grain.position + (grain.radius - touching.overlap[k]) * normal - wall.pivot;
    wall.torque += cross(arm, -force);
  }
}

/// A force acts for half of the step before and half of the step after.
void Stepper::account_walls(double dt) {
  for (const Wall& wall : world_.walls) {
    const double before = dot(wall.force, wall.velocity_before) + dot(wall.torque, wall.angular_velocity_before);
    const double after = dot(wall.force, wall.velocity) + dot(wall.torque, wall.angular_velocity);
    ledger_.work_of_walls -= 0.5 * (dt_ * before + dt * after);
    ledger_.effort_of_walls += 0.5 * (dt_ * std::fabs(before) + dt * std::fabs(after));
  }
}

/// Energies at the time of the positions: the velocities there are the means of the half steps around it.
void Stepper::look_at_energy(double dt) {
  const Particles& particles = world_.particles;
  const double half_kick = 0.25 * (dt_ + dt);
  if (world_.step % kLedgerInterval != 0) return;
  ledger_.kinetic = ledger_.height = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Motion& motion = particles.motion[i];
    const Load& load = particles.load[i];
    const double lightness = particles.spin[i].inverse_mass, m = 1 / lightness;
    const double inertia = 0.4 * m * motion.radius * motion.radius;
    Vec3 v = motion.velocity + (half_kick * lightness) * load.force;
    v.z -= half_kick * world_.gravity;
    const Vec3 w = particles.spin[i].velocity + (half_kick / inertia) * load.torque;
    ledger_.kinetic += 0.5 * (m * dot(v, v) + inertia * dot(w, w));
    ledger_.height += m * world_.gravity * motion.position.z;
  }
  ledger_.stored = energy_.total(EnergySums::stored);
  ledger_.heat_normal = energy_.total(EnergySums::normal_damping);
  ledger_.heat_sliding = energy_.total(EnergySums::sliding);
  ledger_.heat_rolling = energy_.total(EnergySums::rolling);
  ledger_.heat_bridges = energy_.total(EnergySums::bridges);
  if (looked_) return;
  looked_ = true;
  ledger_.start = ledger_.mechanical() + ledger_.heat() - ledger_.work_of_walls;
  ledger_.start_height = ledger_.height;
  ledger_.start_kinetic = ledger_.kinetic;
  ledger_.start_elastic = elastic_energy(world_);
}

void Stepper::integrate(double dt) {
  Particles& particles = world_.particles;
  const double kick = 0.5 * (dt_ + dt);  // from the half step before to the half step after
  const double fall = kick * world_.gravity;
  const double kept = 1 / (1 + kick * world_.drag);
  double fastest = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    Motion& motion = particles.motion[i];
    Spin& spin = particles.spin[i];
    Load& load = particles.load[i];
    const double lightness = spin.inverse_mass;
    const Vec3 velocity_before = motion.velocity, spin_before = spin.velocity;
    motion.velocity += (kick * lightness) * load.force;
    motion.velocity.z -= fall;
    motion.velocity = kept * motion.velocity;
    motion.position += dt * motion.velocity;
    const Vec3 way = motion.position - leeway_.from[i];
    // Written so that a value that is not a number counts as beyond the bound.
    strayed_ |= !(dot(way, way) <= leeway_.distance[i] * leeway_.distance[i]);
    motion.damping_rate = load.damping * lightness;
    const double inverse_inertia = 2.5 * lightness / (motion.radius * motion.radius);
    spin.velocity += (kick * inverse_inertia) * load.torque;
    spin.velocity = kept * spin.velocity;
    if (world_.drag > 0) {
      const double rate = 0.5 * kick * world_.drag;
      ledger_.heat_drag += rate / lightness * dot(motion.velocity, velocity_before + motion.velocity) +
                           rate / inverse_inertia * dot(spin.velocity, spin_before + spin.velocity);
    }
    const double square = dot(motion.velocity, motion.velocity);
    if (!(square < kRunawaySpeed * kRunawaySpeed)) runaway_ = i;
    fastest = std::max(fastest, square);
    load = {};
  }
  particles.load[particles.count()] = {};
  fastest_ = std::sqrt(fastest);
}

Failure Stepper::failure(FailureReason reason, std::int64_t grain, double value, double limit,
                         std::string message) const {
  Failure f;
  f.reason = reason;
  f.step = world_.step;
  f.time_s = world_.time;
  f.grain = grain;
  f.value = value;
  f.limit = limit;
  f.message = std::move(message);
  return f;
}

}  // namespace pastefit
