#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/apparatus/impact/impact.h"
#include "core/observe/readings.h"
#include "core/world/world.h"

namespace pastefit {

/// Decay rate of an oscillation about zero from its first two turning points, ln(|first| / |second|) / (time between
/// them) [1/s]. A turning point is the vertex of the parabola through three samples.
class Swing {
 public:
  /// Samples must be evenly spaced in time.
  void add(double time, double value) {
    if (samples_ >= 2 && turns_.size() < 2 && (value - last_.value) * (last_.value - before_.value) < 0)
      note_turn(value);
    before_ = last_;
    last_ = {time, value};
    ++samples_;
  }
  /// Empty before the second turning point.
  std::optional<double> decay_rate() const {
    if (turns_.size() < 2) return {};
    return std::log(std::fabs(turns_[0].value / turns_[1].value)) / (turns_[1].time - turns_[0].time);
  }

 private:
  struct Sample {
    double time = 0, value = 0;
  };

  void note_turn(double after) {
    const double slope = 0.5 * (after - before_.value), bend = after - 2 * last_.value + before_.value;
    const double step = last_.time - before_.time;
    turns_.push_back({last_.time - slope / bend * step, last_.value - 0.5 * slope * slope / bend});
  }

  Sample before_, last_;
  int samples_ = 0;
  std::vector<Sample> turns_;
};

/// Readings of an impact, updated every step. Grains are indexed as in the test, because the world sorts them.
///
/// The forces of a step act at the positions at its beginning; the velocities there are the means of the half steps
/// before and after. So a step is evaluated when it is over, and the readings belong to its beginning.
class ImpactRecord {
 public:
  /// Requirement: both outlive the record.
  ImpactRecord(const Impact& test, const World& world);

  /// Call before each step.
  void begin_step();
  /// Call after each step, which changed the velocities over the time `kick`.
  void end_step(double kick);

  /// True when the first grain has touched something and has left it, or approaches again (`Impact::rebound_gap_m`).
  bool rebound_is_over() const;

  /// The readings of `simulate(Impact)`, except those of a rotor.
  void read(Readings& readings) const;

 private:
  /// A grain at the time of the last forces.
  struct Sample {
    Vec3 position, velocity, spin;
    Vec3 force;  ///< all forces except its weight [N]
  };

  std::vector<Sample> samples() const;
  double watched_overlap();
  /// Samples at the beginning of the last complete step.
  std::vector<Sample> complete(double kick) const;
  void account_momentum(const std::vector<Sample>& samples, double kick);
  void account_work(const std::vector<Sample>& samples);
  void watch_contact();
  void watch_pulls(double pull);
  void watch_rebound();
  double kinetic_energy() const;
  void read_grains(Readings& readings) const;

  const Impact& test_;
  const World& world_;
  const std::size_t n_;
  std::vector<double> mass_;
  bool first_ = true;  ///< no step is complete yet

  // At the beginning of the current step.
  std::vector<Sample> begun_;
  double begun_s_ = 0, begun_overlap_ = 0;

  // At the beginning of the last complete step.
  std::vector<Sample> now_;
  double now_s_ = 0, overlap_ = 0, pull_ = 0;
  Vec3 towards_nearest_;

  // Since the start.
  double max_overlap_ = 0, max_force_ = 0, contact_time_ = 0;
  std::vector<std::optional<double>> pulls_;
  std::optional<double> top_;  ///< of the first grain since it touched [m]
  bool receded_ = false, came_back_ = false;
  double kinetic_at_start_ = 0;
  Vec3 unexplained_;
  double momentum_size_ = 0;
  std::vector<Vec3> held_force_;
  double work_ = 0;
  Swing swing_;
};

}  // namespace pastefit
