#include <algorithm>
#include <cmath>
#include <vector>

#include "core/apparatus/drive.h"
#include "core/apparatus/granules.h"
#include "core/apparatus/shear_cell/shear_cell.h"
#include "core/observe/heap.h"
#include "core/observe/steady_state.h"
#include "core/step/state_check.h"

namespace pastefit {

namespace {

constexpr double kEmptiest = 0.25;  // least solid fraction of a filled cell
constexpr double kCellRestCap = 1;  // [s] simulated time allowed for coming to rest under the lid
constexpr int kIntervals = 256;     // of displacement, over each of which stress and height are averaged; with a step
                                    // so long that most of them have none there is nothing to read

/// Indices of the walls; the lid is added after filling.
enum : std::size_t { kBase, kBaseRibs, kLeft, kRight, kLid, kLidRibs };

/// Lengths that stay constant at rest: the highest point and the mean height of the granules.
std::vector<double> heights_of_bed(const Particles& particles) {
  double sum = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) sum += particles.motion[i].position.z;
  return {highest_point(particles), sum / particles.count()};
}

Ribs ribs_at(double z, const RibSizes& sizes, double length, double direction) {
  return {{0, 0, z}, sizes.thickness_m, direction * sizes.height_m, even_pitch_m(sizes, length)};
}

World empty_cell(const ShearCell& test, const LooseGrains& grains) {
  World world;
  world.domain.period = test.length_m;
  world.particles = make_particles(grains.centres, grains.radii, test.bulk_density_kg_m3);
  set_contact_model(world, test.contact, test.grains.radius_m);
  world.walls.resize(kLid);
  const double half = 0.5 * test.width_m;
  world.walls[kBase].name = "base";
  world.walls[kBase].shape = Plane{};
  world.walls[kBaseRibs].name = "base ribs";
  world.walls[kBaseRibs].shape = ribs_at(0, test.base_ribs, test.length_m, 1);
  world.walls[kLeft].name = "left side";
  world.walls[kLeft].shape = Plane{{0, -half, 0}, {0, 1, 0}};
  world.walls[kRight].name = "right side";
  world.walls[kRight].shape = Plane{{0, half, 0}, {0, -1, 0}};
  for (Wall& wall : world.walls) wall.pair = wall_pair(test.contact, test.tools, test.grains.radius_m);
  return world;
}

FilledVessel fill_cell(const ShearCell& test, const RunOptions& options) {
  const OpenBox box{test.length_m, test.width_m, test.base_ribs.height_m};
  FilledVessel filled = fill_vessel(
      test, {test.fill_height_m, test.pour_speed_m_s},
      pour(test.grains, test.packing_seed, poured_volume_m3(filled_volume_m3(test)), box),
      [&](const LooseGrains& grains) { return empty_cell(test, grains); }, heights_of_bed, options);
  const double fraction = filled.grains.solid_volume_m3 / filled_volume_m3(test);
  if (!filled.failure && fraction < kEmptiest) filled.failure = bridged(filled, fraction, kEmptiest);
  return filled;
}

/// The phases after filling, one function each.
class Shearing {
 public:
  Shearing(const ShearCell& test, const FilledVessel& filled, const RunOptions& options)
      : test_(test),
        world_(world_under_lid(test, filled)),
        runner_(world_, options, [this](const Particles&) { return heights(); }) {
    runner_.follow(filled.fall);
    double mass = 0;
    for (std::int32_t i = 0; i < world_.particles.count(); ++i) mass += world_.particles.mass(i);
    runner_.remember([this] { return curve_.size() == heights_.size() && summed_ >= 0 && is_finite(curve_); },
                     stress_sum_, height_sum_, summed_, curve_, heights_);
    servo_ = {-test.normal_stress_pa * area_m2(test), mass, test.lid_speed_m_s};
  }

  std::optional<Failure> run() {
    if (auto problem = press_lid_on()) return problem;
    return move_base();
  }

  const RunSummary& summary() { return runner_.summary(); }
  double pressed_height_m() const { return pressed_height_; }
  const std::vector<CurvePoint>& stress_over_displacement() const { return curve_; }
  const std::vector<double>& heights_m() const { return heights_; }

 private:
  static World world_under_lid(const ShearCell& test, const FilledVessel& filled) {
    World world = empty_cell(test, filled.grains);
    const double z = highest_point(world.particles) + test.lid_ribs.height_m + test.grains.radius_m;
    world.walls.resize(kLidRibs + 1);
    world.walls[kLid].name = "lid";
    world.walls[kLid].shape = Plane{{0, 0, z}, {0, 0, -1}};
    world.walls[kLidRibs].name = "lid ribs";
    world.walls[kLidRibs].shape = ribs_at(z, test.lid_ribs, test.length_m, -1);
    for (const std::size_t wall : {kLid, kLidRibs})
      world.walls[wall].pair = wall_pair(test.contact, test.tools, test.grains.radius_m);
    return world;
  }

  /// The bed is at rest only when the lid is, too.
  std::vector<double> heights() const {
    std::vector<double> lengths = heights_of_bed(world_.particles);
    lengths.push_back(lid_height());
    return lengths;
  }
  double lid_height() const { return std::get<Plane>(world_.walls[kLid].shape).point.z; }
  void press_lid(double dt) { press(servo_, {&world_.walls[kLid], &world_.walls[kLidRibs]}, dt); }

  /// Presses the lid until the bed rests under its load.
  std::optional<Failure> press_lid_on() {
    const auto drive = [this](World&, double dt) { press_lid(dt); };
    const double travel = lid_height() - test_.fill_height_m + test_.lid_ribs.height_m;
    if (auto problem = runner_.settle({"press", drive}, kCellRestCap, travel / test_.lid_speed_m_s)) return problem;
    pressed_height_ = lid_height();
    return {};
  }

  std::optional<Failure> move_base() {
    const double speed = test_.shear_speedup * test_.shear_speed_m_s;
    world_.walls[kBase].velocity.x = world_.walls[kBaseRibs].velocity.x = speed;
    const double start = world_.time;
    const auto drive = [&](World&, double dt) {
      press_lid(dt);
      note(speed * (world_.time - start), dt);
    };
    return runner_.run({"shear", drive}, test_.final_displacement_m / speed);
  }

  /// Averages the drag on the lid and its height over each interval of displacement.
  void note(double displacement, double dt) {
    stress_sum_ += dt * (world_.walls[kLid].force.x + world_.walls[kLidRibs].force.x) / area_m2(test_);
    height_sum_ += dt * lid_height();
    summed_ += dt;
    const double interval = test_.final_displacement_m / kIntervals;
    if (displacement < interval * static_cast<double>(curve_.size() + 1)) return;
    curve_.push_back({1e3 * interval * (static_cast<double>(curve_.size()) + 0.5), stress_sum_ / summed_});
    heights_.push_back(height_sum_ / summed_);
    stress_sum_ = height_sum_ = summed_ = 0;
  }

  const ShearCell& test_;
  World world_;
  Runner runner_;
  Servo servo_;
  double pressed_height_ = 0;  ///< of the lid above the base, before shearing [m]
  double stress_sum_ = 0, height_sum_ = 0, summed_ = 0;
  std::vector<CurvePoint> curve_;
  std::vector<double> heights_;
};

/// Largest mean over some consecutive intervals, against noise; together they are shorter than a granule's diameter.
double highest_mean(const std::vector<double>& values) {
  constexpr std::size_t kTogether = kIntervals / 32;
  double highest = 0;
  for (std::size_t k = 0; k + kTogether <= values.size(); ++k) {
    double sum = 0;
    for (std::size_t i = k; i < k + kTogether; ++i) sum += values[i] / kTogether;
    highest = std::max(highest, sum);
  }
  return highest;
}

void read(const Shearing& shearing, Outcome& outcome) {
  const std::vector<CurvePoint>& curve = shearing.stress_over_displacement();
  std::vector<double> stresses;
  for (const CurvePoint& point : curve) stresses.push_back(point.y);
  const SteadyState steady = steady_state(stresses);
  double height = 0;
  for (std::size_t k = steady.first; k < stresses.size(); ++k)
    height += shearing.heights_m()[k] / static_cast<double>(stresses.size() - steady.first);
  outcome.readings.set("shear.stress_pa", steady.mean);
  outcome.readings.set("shear.peak_stress_pa", highest_mean(stresses));
  outcome.readings.set("shear.height_mm", 1e3 * height);
  outcome.readings.set("shear.stress_error_pa", steady.standard_error);
  outcome.readings.set("shear.steady_from_mm", steady.first == 0 ? 0 : curve[steady.first].x);
  outcome.run.settled = outcome.run.settled && steady.reached;
  outcome.curve = Curve{"shear_stress", "displacement_mm", "stress_pa", curve};
}

}  // namespace

Outcome simulate(const ShearCell& test, const RunOptions& asked) {
  Outcome outcome;
  const FilledVessel filled = fill_cell(test, asked);
  outcome.run = filled.run;
  outcome.failure = filled.failure;
  if (outcome.failure) return outcome;
  const double solid = filled.grains.solid_volume_m3;
  outcome.readings.set("bed.mass_g", 1e3 * test.bulk_density_kg_m3 * solid);

  const RunOptions options = with_bounds_of(test, asked);
  Shearing shearing(test, filled, options);
  outcome.failure = shearing.run();
  outcome.run = shearing.summary();
  outcome.run.steps += filled.run.steps;
  outcome.run.particle_steps += filled.run.particle_steps;
  if (asked.fixed_wait_s) outcome.run.settled = false;  // not checked
  if (outcome.failure || shearing.stress_over_displacement().size() < kIntervals / 2) return outcome;
  outcome.readings.set("bed.solid_fraction", solid / (area_m2(test) * shearing.pressed_height_m()));
  outcome.readings.set("bed.height_mm", 1e3 * shearing.pressed_height_m());
  read(shearing, outcome);
  return outcome;
}

}  // namespace pastefit
