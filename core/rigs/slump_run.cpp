#include <algorithm>
#include <cmath>

#include "core/observe/heap.h"
#include "core/rigs/packing.h"
#include "core/rigs/rotor.h"
#include "core/rigs/waiting.h"
#include "core/simulate.h"

namespace pastefit {

namespace {

constexpr double kRestCap = 4.0;   // [s] simulated time allowed for coming to rest
constexpr double kRelaxCap = 0.5;  // [s] for the fill to come to rest under the candidate's own laws
// [1/s]. The grains feel their cohesion all at once when the fill becomes this candidate's; without drag the column
// would swing like a jelly for seconds.
constexpr double kRelaxDrag = 40;
constexpr double kDropCap = 2.0;      // [s] for the plate to reach its stop
constexpr double kGroundDepth = 0.1;  // [m] below the table
constexpr int kStepsPerLook = 64;     // at the highest point of the heap
// [radii] A lost heap may rise by so much again: a mould that drags it along, a column that swings, a grain that hops.
// Twice the most that was seen (tests/bench/README.md).
constexpr double kRebound = 1;

/// The slump test, phase by phase, each as a person in the laboratory would say it.
class SlumpRun {
 public:
  SlumpRun(const SlumpTable& test, const Packing& packing, const RunOptions& options)
      : test_(test), options_(options), world_(make_world(test, packing)), runner_(world_, options) {}

  /// The struck-off surface is level with the rim by definition: the ruler is set to zero slump there. Between the tops
  /// of coarse grains the surface lies a little below it, here as in every later reading, and soft grains settle by a
  /// millimetre or two under their own weight and cohesion.
  std::optional<Failure> relax_in_mould() {
    world_.drag = kRelaxDrag;
    auto problem = options_.fixed_wait_s ? runner_.run("step1.relax", *options_.fixed_wait_s)
                                         : runner_.relax("step1.relax", kRelaxCap);
    if (problem) return problem;
    world_.drag = 0;
    axis_zero_ =
        test_.mould.height_m - height_at_axis(world_.particles, test_.grains.radius_m, test_.reading.probe_diameter_m);
    highest_zero_ = test_.mould.height_m - highest_point(world_.particles);
    if (options_.window)
      lost_below_ =
          options_.window->lowest_m - (reads_axis() ? axis_zero_ : highest_zero_) - kRebound * test_.grains.radius_m;
    return {};
  }

  /// The lift is over when the mould is above the heap; or when it touches nothing and the heap is at rest, because
  /// then nothing can move any more however much farther it rises. With fixed waits: when it has risen by its height.
  std::optional<Failure> lift_mould() {
    Wall& mould = world_.walls[kMould];
    mould.velocity = {0, 0, test_.lift_velocity_m_s};
    const auto clear = [&](const World& world) {
      return world.step % kStepsPerLook == 0 &&
             (std::get<Shell>(mould.shape).base.z > highest_point(world.particles) || lost());
    };
    const auto untouched = [&](const World&) { return norm(mould.force) == 0; };
    const double own_height = test_.mould.height_m / test_.lift_velocity_m_s;
    auto problem = options_.fixed_wait_s ? runner_.run("step1.lift", own_height, {}, look_whether_lost())
                                         : runner_.run_until_rest("step1.lift", 1.5 * own_height, untouched, clear);
    if (problem) return problem;
    world_.walls.pop_back();
    runner_.changed();
    return {};
  }

  /// The heap comes to rest on the table, unless it is lost before.
  std::optional<Failure> rest_on_table() {
    return wait(runner_, options_, "step1.rest", kRestCap, 0, look_whether_lost());
  }

  /// Step 1 is certain to read less than the window holds: no reading of a heap is above its highest point, and that
  /// does not rise again.
  bool lost() const { return lost_below_ > 0 && highest_point(world_.particles) < lost_below_; }

  /// Step 1 reads beyond the window.
  bool is_unwanted(const Observables& readings) const {
    const double height = 1e-3 * readings.find("step1.height_mm").value();
    return options_.window && (height < options_.window->lowest_m || height > options_.window->highest_m);
  }

  std::optional<Failure> rest(std::string_view phase) { return wait(runner_, options_, phase, kRestCap); }

  /// Turns the plate up about its hinge with a smooth start and stop.
  std::optional<Failure> turn_plate_up() {
    const DropPlate& drop = *test_.drop;
    const double angle = std::asin(drop.lift_height_m / drop.length_m);
    const double start = world_.time, duration = drop.lift_duration_s;
    const auto turn = [&](World& world, double dt) {
      const double before = turned_share((world.time - start) / duration);
      const double after = turned_share((world.time + dt - start) / duration);
      // Positive about y lowers the free edge.
      world.walls[kTable].angular_velocity = {0, -angle * (after - before) / dt, 0};
    };
    world_.walls[kTable].pivot = {-0.5 * drop.length_m, 0, 0};
    if (auto problem = runner_.run("step2.raise", duration, turn)) return problem;
    world_.walls[kTable].angular_velocity = {};
    return rest("step2.raised");
  }

  /// Lets the plate go: a rigid rotor under its own weight and the grains on it, stopped dead when it is level.
  std::optional<Failure> let_plate_fall() {
    const DropPlate& drop = *test_.drop;
    const Rotor plate{drop.mass_kg, drop.mass_kg * drop.length_m * drop.length_m / 3};
    bool stopped = false;
    const auto fall = [&](World& world, double dt) {
      if (turn_freely(plate, world.walls[kTable], world.gravity, dt, dt)) stopped = true;
    };
    if (auto problem = runner_.run("step2.drop", kDropCap, fall, [&](const World&) { return stopped; })) return problem;
    Wall& table = world_.walls[kTable];
    table.angular_velocity = {};
    table.shape = level_table(test_);
    if (stopped) return {};
    return Failure{FailureReason::never_settled,
                   "step2.drop",
                   world_.step,
                   world_.time,
                   -1,
                   0,
                   kDropCap,
                   "the plate did not fall to its stop; check its mass and lift height"};
  }

  void read(std::string_view step, Observables& readings) const {
    const Particles grains = on_table();
    const double radius = test_.grains.radius_m, probe = test_.reading.probe_diameter_m;
    // A fill that stood above the rim has a ruler that would read less than nothing where all has flowed away.
    const double axis = std::max(axis_zero_ + height_at_axis(grains, radius, probe), 0.0);
    const double highest = std::max(highest_zero_ + highest_point(grains), 0.0);
    const double height = reads_axis() ? axis : highest;
    const auto set = [&](const char* name, double value) { readings.set(std::string(step) + name, value); };
    set(".height_mm", 1e3 * height);
    set(".slump_mm", 1e3 * (test_.mould.height_m - height));
    set(".height_axis_mm", 1e3 * axis);
    set(".height_max_mm", 1e3 * highest);
    set(".spread_mm", 1e3 * spread_diameter(grains, radius));
    set(".spilled_share", 1 - static_cast<double>(grains.count()) / world_.particles.count());
    if (step == "step1") return;
    const Plateau top = plateau(grains, radius, probe, 0.5 * test_.table_length_m);
    set(".plateau_sag_mm", 1e3 * top.sag);
    set(".plateau_width_mm", 1e3 * top.width);
  }

  const RunSummary& summary() { return runner_.summary(); }

 private:
  static constexpr std::size_t kTable = 0, kMould = 2;

  bool reads_axis() const { return test_.reading.height == HeightReading::axis; }

  std::function<bool(const World&)> look_whether_lost() const {
    return [this](const World& world) { return world.step % kStepsPerLook == 0 && lost(); };
  }

  static double table_length(const SlumpTable& test) { return test.drop ? test.drop->length_m : test.table_length_m; }

  static Plate level_table(const SlumpTable& test) {
    Plate plate;
    plate.half_length = plate.half_width = 0.5 * table_length(test);
    return plate;
  }

  /// Share of the angle turned through at share s of the time: smooth start and stop.
  static double turned_share(double s) {
    s = std::clamp(s, 0.0, 1.0);
    return s * s * (3 - 2 * s);
  }

  Particles on_table() const {
    std::vector<Vec3> centres;
    std::vector<double> radii;
    for (std::int32_t i = 0; i < world_.particles.count(); ++i) {
      const Motion& grain = world_.particles.motion[i];
      if (grain.position.z < 0) continue;
      centres.push_back(grain.position);
      radii.push_back(grain.radius);
    }
    return make_particles(centres, radii, world_.particles.density_kg_m3);
  }

  static World make_world(const SlumpTable& test, const Packing& packing) {
    World world;
    const double density = test.bulk_density_kg_m3 * volume_m3(test.mould) / packing.solid_volume_m3;
    world.particles = make_particles(packing.centres, packing.radii, density);
    set_contact_model(world, test.contact, test.grains.radius_m);
    Wall table;
    table.name = "table";
    table.shape = level_table(test);
    table.pair = wall_pair(test.contact, test.table_wall, test.grains.radius_m);
    Wall mould;
    mould.name = "mould";
    mould.shape = Shell{{}, test.mould.base_radius_m, test.mould.top_radius_m, test.mould.height_m};
    mould.pair = wall_pair(test.contact, test.mould_wall, test.grains.radius_m);
    // Grains that flow over the table's edge land on the ground and are counted as spilled.
    Wall ground;
    ground.name = "ground";
    ground.shape = Plane{{0, 0, -kGroundDepth}};
    ground.pair = table.pair;
    ground.pair.rolling_friction = 1;
    world.walls = {table, ground, mould};
    return world;
  }

  const SlumpTable& test_;
  const RunOptions& options_;
  World world_;
  Runner runner_;
  double axis_zero_ = 0, highest_zero_ = 0;  ///< rim less reading of the struck-off fill [m]
  double lost_below_ = 0;                    ///< highest point [m]
};

}  // namespace

std::vector<std::string> observable_names(const SlumpTable& test) {
  std::vector<std::string> names{"fill.mass_kg", "fill.solid_fraction"};
  const auto add = [&](const std::string& step) {
    for (const char* name :
         {".height_mm", ".slump_mm", ".height_axis_mm", ".height_max_mm", ".spread_mm", ".spilled_share"})
      names.push_back(step + name);
  };
  add("step1");
  if (!test.drop) return names;
  add("step2");
  names.push_back("step2.plateau_sag_mm");
  names.push_back("step2.plateau_width_mm");
  return names;
}

Outcome simulate(const SlumpTable& test, const RunOptions& options) {
  Outcome outcome;
  const std::shared_ptr<const Packing> packing = options.packing ? options.packing : fill_mould(test, options);
  outcome.failure = packing->failure;
  if (outcome.failure) {
    outcome.run = packing->run;
    return outcome;
  }
  SlumpRun run(test, *packing, options);
  const double volume = volume_m3(test.mould);
  outcome.observables.set("fill.mass_kg", test.bulk_density_kg_m3 * volume);
  outcome.observables.set("fill.solid_fraction", packing->solid_volume_m3 / volume);
  bool ended_early = false;
  const auto perform = [&] {
    if (auto problem = run.relax_in_mould()) return problem;
    if (auto problem = run.lift_mould()) return problem;
    if (!run.lost())
      if (auto problem = run.rest_on_table()) return problem;
    ended_early = run.lost();
    if (ended_early) return std::optional<Failure>{};
    run.read("step1", outcome.observables);
    if (!test.drop) return std::optional<Failure>{};
    ended_early = run.is_unwanted(outcome.observables);
    if (ended_early) return std::optional<Failure>{};
    if (auto problem = run.turn_plate_up()) return problem;
    if (auto problem = run.let_plate_fall()) return problem;
    if (auto problem = run.rest("step2.rest")) return problem;
    run.read("step2", outcome.observables);
    return std::optional<Failure>{};
  };
  outcome.failure = perform();
  outcome.run = run.summary();
  outcome.run.ended_early = ended_early;
  if (options.fixed_wait_s) outcome.run.settled = false;  // nobody looked
  if (!options.packing) {
    outcome.run.steps += packing->run.steps;
    outcome.run.particle_steps += packing->run.particle_steps;
  }
  return outcome;
}

}  // namespace pastefit
