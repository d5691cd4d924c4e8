#include "core/apparatus/slump/plate_drop.h"

#include <algorithm>
#include <cmath>

#include "core/apparatus/rotor.h"
#include "core/apparatus/slump/slump_world.h"
#include "core/observe/heap.h"
#include "core/step/runner.h"

namespace pastefit {

namespace {

constexpr int kSides = 2;         // of the heap, opposite ones, the hinge is on in turn
constexpr double kDropCap = 2.0;  // [s] for the plate to reach its stop

/// One fall of the plate under a heap.
class Drop {
 public:
  Drop(const SlumpTest& test, World world, const EnergyBalance& before, const RunOptions& options)
      : test_(test),
        world_(std::move(world)),
        runner_(world_, options, rest_measure_of_heap),
        table_(world_.walls[kTable]) {
    runner_.follow(before);
    runner_.remember([] { return true; }, stopped_);
  }

  std::optional<Failure> run() {
    if (auto problem = turn_plate_up()) return problem;
    if (auto problem = let_plate_fall()) return problem;
    if (auto problem = rest("step2.rest")) return problem;
    return runner_.show("step2.rest");
  }

  const Particles& grains() const { return world_.particles; }
  const RunSummary& summary() { return runner_.summary(); }

 private:
  std::optional<Failure> rest(std::string_view phase) { return runner_.settle({phase}, kRestCap); }

  /// Turns the plate up about its hinge with a smooth start and stop.
  std::optional<Failure> turn_plate_up() {
    const DropPlate& plate = *test_.drop;
    const double angle = std::asin(plate.lift_height_m / plate.length_m);
    const double start = world_.time, duration = plate.lift_duration_s;
    const auto turn = [&](World& world, double dt) {
      const double before = turned_share((world.time - start) / duration);
      const double after = turned_share((world.time + dt - start) / duration);
      // Positive about y lowers the free edge.
      table_.angular_velocity = {0, -angle * (after - before) / dt, 0};
    };
    table_.pivot = {-0.5 * plate.length_m, 0, 0};
    if (auto problem = runner_.run({"step2.raise", turn}, duration)) return problem;
    table_.angular_velocity = {};
    return rest("step2.raised");
  }

  /// Lets the plate go: a rigid rotor under its own weight and the grains on it, stopped dead when it is level.
  std::optional<Failure> let_plate_fall() {
    const DropPlate& plate = *test_.drop;
    const Rotor rotor{plate.mass_kg, plate.mass_kg * plate.length_m * plate.length_m / 3};
    const auto fall = [&](World& world, double dt) {
      if (turn_freely(rotor, table_, world.gravity, dt, dt)) stopped_ = true;
    };
    if (auto problem = runner_.run({"step2.drop", fall, [&](const World&) { return stopped_; }}, kDropCap))
      return problem;
    table_.angular_velocity = {};
    table_.shape = level_table(test_);
    if (stopped_) return {};
    return Failure{FailureReason::never_settled,
                   "step2.drop",
                   world_.step,
                   world_.time,
                   -1,
                   0,
                   kDropCap,
                   "the plate did not fall to its stop; check its mass and lift height"};
  }

  /// Share of the angle turned through at share s of the time: smooth start and stop.
  static double turned_share(double s) {
    s = std::clamp(s, 0.0, 1.0);
    return s * s * (3 - 2 * s);
  }

  const SlumpTest& test_;
  World world_;
  Runner runner_;
  Wall& table_;
  bool stopped_ = false;  ///< the plate has fallen
};

}  // namespace

Outcome drop_plate(const SlumpTest& test, const World& rested, const Ruler& ruler, const EnergyBalance& before,
                   const RunOptions& options) {
  Outcome mean;
  mean.run.settled = true;
  World world = rested;
  std::vector<Observables> of_sides;
  for (int side = 0; side < kSides; ++side) {
    RunOptions of_side = options;
    if (options.watch)
      of_side.watch = [&](Snapshot snapshot) {
        snapshot.drop = side;
        return options.watch(snapshot);
      };
    Drop drop(test, world, before, of_side);
    mean.failure = drop.run();
    const RunSummary& run = drop.summary();
    mean.run.steps += run.steps;
    mean.run.particle_steps += run.particle_steps;
    mean.run.simulated_s += run.simulated_s - rested.time;
    mean.run.advised_step_s = side == 0 ? run.advised_step_s : std::min(mean.run.advised_step_s, run.advised_step_s);
    if (run.energy_error && std::fabs(*run.energy_error) >= std::fabs(mean.run.energy_error.value_or(0)))
      mean.run.energy_error = run.energy_error;
    mean.run.settled = mean.run.settled && run.settled;
    if (mean.failure) return mean;
    ruler.read(drop.grains(), "step2", of_sides.emplace_back());
    turn_half_round(world);
  }
  mean.observables = mean_of(of_sides);
  return mean;
}

}  // namespace pastefit
