#include <algorithm>
#include <vector>

#include "core/apparatus/granules.h"
#include "core/apparatus/pellet_crush/pellet_crush.h"
#include "core/observe/heap.h"
#include "core/step/runner.h"
#include "core/step/state_check.h"

namespace pastefit {

double grains_needed(const PelletCrush& test) {
  return number_of_granules(test, poured_volume_m3(filled_volume_m3(test)));
}

namespace {

constexpr double kEmptiest = 0.25;  // least solid fraction of a filled die

World empty_die(const PelletCrush& test, const LooseGrains& grains) {
  World world;
  world.particles = make_particles(grains.centres, grains.radii, test.bulk_density_kg_m3);
  set_contact_model(world, test.contact, test.grains.radius_m);
  const PairConstants surface = wall_pair(test.contact, test.tools, test.grains.radius_m);
  const double radius = 0.5 * test.die_diameter_m, top = std::max(top_of(grains), test.fill_height_m);
  Wall floor, die;
  floor.name = "floor";
  floor.shape = Plane{};
  floor.pair = surface;
  die.name = "die";
  die.shape = Shell{{}, radius, radius, top + 2 * test.grains.radius_m};
  die.pair = surface;
  world.walls = {floor, die};
  return world;
}

/// Granules in the die of `test`, struck off and at rest; or the reason why filling failed.
FilledVessel fill_die(const PelletCrush& test, const RunOptions& options) {
  const double radius = 0.5 * test.die_diameter_m;
  FilledVessel filled = fill_vessel(
      test, {test.fill_height_m, test.pour_speed_m_s},
      pour(test.grains, test.packing_seed, poured_volume_m3(filled_volume_m3(test)), radius,
           [&](double) { return radius; }),
      [&](const LooseGrains& grains) { return empty_die(test, grains); }, rest_measure_of_heap, options);
  const double fraction = filled.grains.solid_volume_m3 / filled_volume_m3(test);
  if (!filled.failure && fraction < kEmptiest) filled.failure = bridged(filled, fraction, kEmptiest);
  return filled;
}

constexpr int kStepsPerLook = 64;           // between two checks for fallen granules and for the clearance of the punch
constexpr double kPelletRestCap = 1;        // [s] simulated time allowed for coming to rest
constexpr double kBeyond = 1.25;            // of the die's radius: granules farther out have fallen off
constexpr double kMostFallen = 0.25;        // of the mass; with more, the pellet has collapsed
constexpr double kStrainInterval = 0.0025;  // over which the platen force is averaged, as by a load cell

/// Index of the wall between floor and, until it is removed, die. The punch becomes the platen.
constexpr std::size_t kPunch = 1;

/// Pressing and crushing, one function per phase.
class Pressing {
 public:
  Pressing(const PelletCrush& test, const FilledVessel& filled, const RunOptions& options)
      : test_(test),
        options_(options),
        world_(filled_world(test, filled)),
        runner_(world_, options, rest_measure_of_heap) {
    runner_.follow(filled.fall);
    runner_.remember([this] { return summed_ >= 0 && is_finite(curve_); }, sum_, summed_, curve_);
  }

  std::optional<Failure> run() {
    if (auto problem = press()) return problem;
    if (auto problem = withdraw_punch()) return problem;
    if (auto problem = take_away_die()) return problem;
    return crush();
  }

  const RunSummary& summary() { return runner_.summary(); }
  double pellet_height_m() const { return pellet_height_; }
  const std::vector<CurvePoint>& stress_over_strain() const { return curve_; }

 private:
  static World filled_world(const PelletCrush& test, const FilledVessel& filled) {
    World world;
    world.particles = make_particles(filled.grains.centres, filled.grains.radii, test.bulk_density_kg_m3);
    set_contact_model(world, test.contact, test.grains.radius_m);
    const double top = std::max(highest_point(world.particles), test.fill_height_m);
    const double radius = 0.5 * test.die_diameter_m;
    Wall floor, punch, die;
    floor.name = "floor";
    floor.shape = Plane{};
    punch.name = "punch";
    punch.shape = Plane{{0, 0, top}, {0, 0, -1}};
    die.name = "die";
    die.shape = Shell{{}, radius, radius, top + 2 * test.grains.radius_m};
    world.walls = {floor, punch, die};
    for (Wall& wall : world.walls) wall.pair = wall_pair(test.contact, test.tools, test.grains.radius_m);
    return world;
  }

  Wall& punch() { return world_.walls[kPunch]; }
  double height_of_punch() const { return std::get<Plane>(world_.walls[kPunch].shape).point.z; }

  std::optional<Failure> press() {
    const double speed = test_.press_speedup * test_.punch_speed_m_s;
    punch().velocity = {0, 0, -speed};
    const PhaseLeft rest{0, options_.fixed_wait_s.value_or(kPelletRestCap)};
    if (auto problem =
            runner_.run({.name = "press", .after = rest}, (height_of_punch() - test_.pressed_height_m) / speed))
      return problem;
    punch().velocity = {};
    return runner_.settle({"press"}, kPelletRestCap);
  }

  /// Withdraws the punch until no granule follows.
  std::optional<Failure> withdraw_punch() {
    const double speed = test_.press_speedup * test_.punch_speed_m_s;
    punch().velocity = {0, 0, speed};
    const auto is_clear = [&] { return height_of_punch() > highest_point(world_.particles) + test_.grains.radius_m; };
    const auto done = [&](const World& world) { return world.step % kStepsPerLook == 0 && is_clear(); };
    const PhaseLeft rest{0, options_.fixed_wait_s.value_or(kPelletRestCap)};
    if (auto problem = runner_.run({"withdraw", {}, done, rest}, 2 * test_.fill_height_m / speed)) return problem;
    if (!is_clear())
      return apart("withdraw", highest_point(world_.particles), height_of_punch(),
                   "granules stick to the punch and leave the die with it; give the tools a smaller cohesion_factor");
    punch().velocity = {};
    return runner_.settle({"withdraw"}, kPelletRestCap);
  }

  std::optional<Failure> take_away_die() {
    runner_.take_away_last_wall();
    const auto fallen = [this](const World& world) { return world.step % kStepsPerLook == 0 && fell_apart(); };
    if (auto problem = runner_.settle({"release", {}, fallen}, kPelletRestCap)) return problem;
    pellet_height_ = highest_point(world_.particles);
    if (!fell_apart()) return {};
    return apart("release", fallen_share(), kMostFallen,
                 "the pellet does not stand without its die; give more surface energy, or press it more");
  }

  Failure apart(const char* phase, double value, double limit, const char* message) const {
    return {FailureReason::fell_apart, phase, world_.step, world_.time, -1, value, limit, message};
  }

  std::optional<Failure> crush() {
    Wall& platen = punch();
    platen.name = "platen";
    std::get<Plane>(platen.shape).point.z = pellet_height_;
    platen.velocity = {0, 0, -test_.platen_speed_m_s};
    runner_.changed();
    const auto weigh = [this](const World&) {
      note_force();
      return false;
    };
    return runner_.run({"crush", {}, weigh}, test_.final_strain * pellet_height_ / test_.platen_speed_m_s);
  }

  /// Mean force of each strain interval.
  void note_force() {
    const Wall& platen = world_.walls[kPunch];
    sum_ += platen.force.z;
    ++summed_;
    const double strain = 1 - height_of_punch() / pellet_height_;
    if (strain < kStrainInterval * static_cast<double>(curve_.size() + 1)) return;
    curve_.push_back({strain - 0.5 * kStrainInterval, sum_ / summed_ / area_m2(test_)});
    sum_ = summed_ = 0;
  }

  double fallen_share() const {
    const double bound = kBeyond * 0.5 * test_.die_diameter_m;
    double fallen = 0, all = 0;
    for (std::int32_t i = 0; i < world_.particles.count(); ++i) {
      const Vec3& p = world_.particles.motion[i].position;
      const double mass = world_.particles.mass(i);
      all += mass;
      if (p.x * p.x + p.y * p.y > bound * bound) fallen += mass;
    }
    return fallen / all;
  }
  bool fell_apart() const { return fallen_share() > kMostFallen; }

  const PelletCrush& test_;
  const RunOptions& options_;
  World world_;
  Runner runner_;
  double pellet_height_ = 0;  ///< without the die, at rest [m]
  double sum_ = 0, summed_ = 0;
  std::vector<CurvePoint> curve_;
};

}  // namespace

Outcome simulate(const PelletCrush& test, const RunOptions& asked) {
  Outcome outcome;
  const FilledVessel filled = fill_die(test, asked);
  outcome.run = filled.run;
  outcome.failure = filled.failure;
  if (outcome.failure) return outcome;
  outcome.readings.set("die.mass_g", 1e3 * test.bulk_density_kg_m3 * filled.grains.solid_volume_m3);
  outcome.readings.set("die.solid_fraction", filled.grains.solid_volume_m3 / filled_volume_m3(test));

  const RunOptions options = with_bounds_of(test, asked);
  Pressing pressing(test, filled, options);
  outcome.failure = pressing.run();
  outcome.run = pressing.summary();
  outcome.run.steps += filled.run.steps;
  outcome.run.particle_steps += filled.run.particle_steps;
  if (asked.fixed_wait_s) outcome.run.settled = false;  // not checked
  const std::vector<CurvePoint>& curve = pressing.stress_over_strain();
  if (outcome.failure || curve.empty()) return outcome;

  const auto peak = std::ranges::max_element(curve, {}, &CurvePoint::y);
  outcome.readings.set("pellet.height_mm", 1e3 * pressing.pellet_height_m());
  outcome.readings.set("pellet.dynamic_yield_strength_pa", peak->y);
  outcome.readings.set("pellet.strain_at_peak", peak->x);
  outcome.curve = Curve{"stress_strain", "strain", "stress_pa", curve};
  return outcome;
}

}  // namespace pastefit
