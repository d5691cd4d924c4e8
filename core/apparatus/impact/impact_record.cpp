#include "core/apparatus/impact/impact_record.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/world/nearest.h"

namespace pastefit {

ImpactRecord::ImpactRecord(const Impact& test, const World& world)
    : test_(test), world_(world), n_(test.grains.size()), now_(n_), pulls_(test.pull_gaps_m.size()), held_force_(n_) {
  for (const ImpactGrain& grain : test.grains) mass_.push_back(mass_kg(test, grain));
}

void ImpactRecord::begin_step() {
  begun_s_ = world_.time;
  begun_overlap_ = watched_overlap();
  begun_ = samples();
}

void ImpactRecord::end_step(double kick) {
  const std::vector<Sample> before = complete(kick);
  account_momentum(before, kick);
  account_work(before);
  now_ = before;
  watch_contact();
  watch_rebound();
  swing_.add(begun_s_, dot(now_[0].position - test_.grains[0].centre_m, test_.grains[0].velocity_m_s));
  if (first_) kinetic_at_start_ = kinetic_energy();
  first_ = false;
  now_s_ = begun_s_;
}

bool ImpactRecord::rebound_is_over() const {
  return test_.rebound_gap_m && top_ && (came_back_ || -overlap_ > *test_.rebound_gap_m);
}

std::vector<ImpactRecord::Sample> ImpactRecord::samples() const {
  std::vector<Sample> samples(n_);
  const Particles& particles = world_.particles;
  for (std::int32_t i = 0; i < particles.count(); ++i)
    samples[particles.identity[i]] = {
        particles.motion[i].position, particles.velocity[i].linear, particles.velocity[i].angular, {}};
  return samples;
}

std::vector<ImpactRecord::Sample> ImpactRecord::complete(double kick) const {
  std::vector<Sample> before = begun_;
  const std::vector<Sample> after = samples();
  const Vec3 weight{0, 0, -test_.gravity_m_s2};
  for (std::size_t i = 0; i < n_; ++i) {
    Sample& sample = before[i];
    sample.force = mass_[i] * ((1 / kick) * (after[i].velocity - sample.velocity) - weight);
    if (first_) continue;  // at the first step, velocities belong to the positions
    sample.velocity = 0.5 * (sample.velocity + after[i].velocity);
    sample.spin = 0.5 * (sample.spin + after[i].spin);
  }
  return before;
}

/// Overlap of the first grain with its nearest neighbour or wall.
double ImpactRecord::watched_overlap() {
  const std::vector<Sample> grains = samples();
  const double radius = test_.grains[0].radius_m;
  double deepest = -1e300;
  for (std::size_t j = 1; j < n_; ++j) {
    const Vec3 between = grains[j].position - grains[0].position;
    const double distance = norm(between), overlap = radius + test_.grains[j].radius_m - distance;
    if (overlap <= deepest) continue;
    deepest = overlap;
    towards_nearest_ = (1 / distance) * between;
  }
  for (const Wall& wall : world_.walls) {
    const Nearest point = nearest(wall.shape, grains[0].position);
    if (radius - point.distance <= deepest) continue;
    deepest = radius - point.distance;
    towards_nearest_ = point.direction;
  }
  return deepest;
}

void ImpactRecord::account_momentum(const std::vector<Sample>& samples, double kick) {
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

void ImpactRecord::account_work(const std::vector<Sample>& samples) {
  for (std::size_t i = 0; i < n_; ++i) {
    if (!test_.grains[i].held) continue;
    if (!first_) work_ -= 0.5 * dot(held_force_[i] + samples[i].force, samples[i].position - now_[i].position);
    held_force_[i] = samples[i].force;
  }
}

void ImpactRecord::watch_contact() {
  const double depth = begun_overlap_;
  const double pull = dot(now_[0].force, towards_nearest_);
  max_force_ = std::max(max_force_, norm(now_[0].force));
  max_overlap_ = first_ ? depth : std::max(max_overlap_, depth);
  if (!first_) {
    const double interval = begun_s_ - now_s_;
    const double inside = std::max(depth, 0.0) + std::max(overlap_, 0.0), spanned = std::fabs(depth - overlap_);
    // Share of the interval with positive overlap, interpolated linearly.
    if (depth > 0 && overlap_ > 0)
      contact_time_ += interval;
    else if (inside > 0)
      contact_time_ += interval * inside / spanned;
    watch_pulls(pull);
  }
  overlap_ = depth;
  pull_ = pull;
}

/// Records gaps passed between the last two times.
void ImpactRecord::watch_pulls(double pull) {
  for (std::size_t k = 0; k < pulls_.size(); ++k) {
    const double from_start = -test_.pull_gaps_m[k] - overlap_, step = begun_overlap_ - overlap_;
    if (step == 0 || from_start / step < 0 || from_start / step > 1) continue;
    pulls_[k] = pull_ + from_start / step * (pull - pull_);
  }
}

void ImpactRecord::watch_rebound() {
  if (overlap_ <= 0 && !top_) return;
  top_ = std::max(top_.value_or(now_[0].position.z), now_[0].position.z);
  const bool recedes = dot(now_[0].velocity, towards_nearest_) < 0;
  came_back_ = came_back_ || (receded_ && !recedes);
  receded_ = receded_ || recedes;
}

double ImpactRecord::kinetic_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    const double r = test_.grains[i].radius_m;
    const Vec3 &v = now_[i].velocity, &w = now_[i].spin;
    sum += mass_[i] * (0.5 * dot(v, v) + 0.2 * r * r * dot(w, w));
  }
  return sum;
}

void ImpactRecord::read_grains(Readings& readings) const {
  const auto set = [&](const std::string& grain, const char* what, const char* unit, const Vec3& v) {
    const std::string name = grain + "." + what;
    readings.set(name + "_x_" + unit, v.x);
    readings.set(name + "_y_" + unit, v.y);
    readings.set(name + "_z_" + unit, v.z);
  };
  for (std::size_t i = 0; i < n_; ++i) {
    const std::string grain = "grain" + std::to_string(i);
    set(grain, "position", "m", now_[i].position);
    set(grain, "velocity", "m_s", now_[i].velocity);
    set(grain, "spin", "rad_s", now_[i].spin);
    readings.set(grain + ".speed_m_s", norm(now_[i].velocity));
  }
  if (n_ > 1) readings.set("relative_speed_m_s", norm(now_[0].velocity - now_[1].velocity));
}

void ImpactRecord::read(Readings& readings) const {
  read_grains(readings);
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
  readings.set("time_s", now_s_);
}

}  // namespace pastefit
