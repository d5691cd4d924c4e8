#include "core/apparatus/slump/plate_drop.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/apparatus/drive.h"
#include "core/apparatus/slump/packing.h"
#include "core/observe/heap.h"
#include "core/step/runner.h"

namespace pastefit {

namespace {

constexpr double kDropCap = 2.0;  // [s] allowed for the plate to reach its stop

/// The phases of one drop.
struct DropPhases {
  std::string_view raise, fall, rest;
};
constexpr DropPhases kFirst{"step2.raise", "step2.drop", "step2.rest"};
constexpr DropPhases kNext{"drops.raise", "drops.fall", "drops.rest"};
constexpr DropPhases kLast{"drops.raise", "drops.fall", "after_drops.rest"};

/// Raises and drops a plate with a heap on it.
class Drop {
 public:
  Drop(const SlumpTest& test, World world, const EnergyBalance& before, const RunOptions& options)
      : test_(test),
        options_(options),
        world_(std::move(world)),
        runner_(world_, options_, rest_measure_of_heap),
        table_(world_.walls[kTable]) {
    runner_.follow(before);
    runner_.remember([] { return true; }, stopped_);
  }

  /// The first drop, from rest to rest.
  std::optional<Failure> run() {
    if (auto problem = raise(kFirst)) return problem;
    if (is_hinged())
      if (auto problem = rest("step2.raised")) return problem;
    if (auto problem = let_fall(kFirst)) return problem;
    if (auto problem = rest(kFirst.rest)) return problem;
    return runner_.show(kFirst.rest);
  }

  /// Further drops at the period of the test; calls `after_each(number)` after each of them, counted from 2.
  std::optional<Failure> go_on(const std::function<void(int)>& after_each) {
    for (int number = 2; number <= plate().drops; ++number) {
      const bool last = number == plate().drops;
      const DropPhases& phases = last ? kLast : kNext;
      if (auto problem = raise(phases)) return problem;
      if (auto problem = let_fall(phases)) return problem;
      if (auto problem = last ? rest(phases.rest) : rest_between(phases.rest)) return problem;
      after_each(number);
    }
    return runner_.show(kLast.rest);
  }

  const Particles& grains() const { return world_.particles; }
  const RunSummary& summary() { return runner_.summary(); }

 private:
  const DropPlate& plate() const { return *test_.drop; }
  bool is_hinged() const { return plate().motion == TableMotion::hinged; }

  std::optional<Failure> rest(std::string_view phase) { return runner_.settle({phase}, kRestCap); }

  /// No reading is taken between two drops: wait until the heap is calm for one short window, or until the next drop.
  std::optional<Failure> rest_between(std::string_view phase) {
    if (options_.fixed_wait_s) return rest(phase);
    const RestCriterion to_be_read = options_.rest;
    options_.rest = {0.5 * to_be_read.window_s, 1, to_be_read.speed_over_fall, 0.5 * to_be_read.change_over_radius};
    auto problem =
        runner_.run_until_rest({phase}, plate().period_s - moving_time_s(plate()), [](const World&) { return true; });
    options_.rest = to_be_read;
    return problem;
  }

  std::optional<Failure> raise(const DropPhases& phases) {
    if (is_hinged()) return turn_up(phases);
    set_up();
    return {};
  }

  /// Rotates the plate about its hinge with a smooth start and stop.
  std::optional<Failure> turn_up(const DropPhases& phases) {
    const double angle = std::asin(plate().lift_height_m / plate().length_m);
    const double start = world_.time, duration = plate().lift_duration_s;
    const auto turn = [&](World& world, double dt) {
      const double before = turned_share((world.time - start) / duration);
      const double after = turned_share((world.time + dt - start) / duration);
      // Positive rotation about y lowers the free edge.
      table_.angular_velocity = {0, -angle * (after - before) / dt, 0};
    };
    table_.pivot = {-0.5 * plate().length_m, 0, 0};
    if (auto problem = runner_.run({phases.raise, turn}, duration)) return problem;
    table_.angular_velocity = {};
    return {};
  }

  /// Raises a vertical table and the heap on it at once, since a cam lifts too slowly to disturb the heap. Grains off
  /// the table stay below.
  void set_up() {
    double work = 0;
    Particles& grains = world_.particles;
    for (std::int32_t i = 0; i < grains.count(); ++i) {
      if (grains.motion[i].position.z < 0) continue;
      grains.motion[i].position.z += plate().lift_height_m;
      work += grains.mass(i) * world_.gravity * plate().lift_height_m;
    }
    std::get<Shell>(table_.shape).base.z += plate().lift_height_m;
    runner_.lifted(work);
  }

  /// Releases the plate: a rigid body under its own weight and the grains on it, stopped dead on its seat.
  std::optional<Failure> let_fall(const DropPhases& phases) {
    stopped_ = false;
    const Rotor rotor{plate().mass_kg, plate().mass_kg * plate().length_m * plate().length_m / 3};
    const auto fall = [&](World& world, double dt) {
      if (is_hinged() ? turn_freely(rotor, table_, world.gravity, dt, dt).has_value() : sink_freely(world.gravity, dt))
        stopped_ = true;
    };
    if (auto problem = runner_.run({phases.fall, fall, [&](const World&) { return stopped_; }}, kDropCap))
      return problem;
    table_.angular_velocity = table_.velocity = {};
    table_.shape = table_on_seat(test_);
    if (stopped_) return {};
    return Failure{FailureReason::never_settled,
                   std::string(phases.fall),
                   world_.step,
                   world_.time,
                   -1,
                   0,
                   kDropCap,
                   "the plate did not fall to its stop; check its mass and lift height"};
  }

  /// One step of a table that falls vertically, M dv/dt = F_grains - M g; true when it reaches its seat, at the end of
  /// the step.
  bool sink_freely(double gravity, double dt) {
    const double above = std::get<Shell>(table_.shape).base.z;
    double& speed = table_.velocity.z;
    speed += dt * (table_.force.z / plate().mass_kg - gravity);
    if (above + speed * dt > 0) return false;
    speed = -above / dt;
    return true;
  }

  /// Share of the angle at share s of the time, with a smooth start and stop.
  static double turned_share(double s) {
    s = std::clamp(s, 0.0, 1.0);
    return s * s * (3 - 2 * s);
  }

  const SlumpTest& test_;
  RunOptions options_;
  World world_;
  Runner runner_;
  Wall& table_;
  bool stopped_ = false;  ///< the plate has reached its stop
};

/// Adds the run of one side to those of earlier sides.
void add_side(RunSummary& sum, const RunSummary& run, double since_s, bool first) {
  sum.steps += run.steps;
  sum.particle_steps += run.particle_steps;
  sum.simulated_s += run.simulated_s - since_s;
  sum.advised_step_s = first ? run.advised_step_s : std::min(sum.advised_step_s, run.advised_step_s);
  if (run.energy_error && std::fabs(*run.energy_error) >= std::fabs(sum.energy_error.value_or(0)))
    sum.energy_error = run.energy_error;
  sum.settled = sum.settled && run.settled;
}

/// All further drops and their readings.
std::optional<Failure> drop_again(Drop& drop, const Ruler& ruler, Outcome& outcome) {
  outcome.curve = Curve{"spread_over_drops", "drops", "spread_mm", {{1, 1e3 * ruler.spread_m(drop.grains())}}};
  return drop.go_on([&](int number) {
    outcome.curve->points.push_back({static_cast<double>(number), 1e3 * ruler.spread_m(drop.grains())});
  });
}

}  // namespace

Outcome drop_plate(const SlumpTest& test, const World& rested, const Ruler& ruler, const EnergyBalance& before,
                   const RunOptions& options) {
  Outcome outcome;
  outcome.run.settled = true;
  World world = rested;
  std::vector<Readings> of_sides;
  Readings after_drops;
  const int sides = test.drop->motion == TableMotion::hinged ? 2 : 1;  // hinge on opposite sides in turn
  for (int side = 0; side < sides; ++side) {
    RunOptions of_side = options;
    if (options.watch)
      of_side.watch = [&](Snapshot snapshot) {
        snapshot.drop = side;
        return options.watch(snapshot);
      };
    Drop drop(test, world, before, of_side);
    outcome.failure = drop.run();
    if (!outcome.failure) ruler.read(drop.grains(), "step2", of_sides.emplace_back());
    if (!outcome.failure && side == 0 && test.drop->drops > 1) {
      outcome.failure = drop_again(drop, ruler, outcome);
      if (!outcome.failure) ruler.read_after_drops(drop.grains(), after_drops);
    }
    add_side(outcome.run, drop.summary(), rested.time, side == 0);
    if (outcome.failure) return outcome;
    turn_half_round(world);
  }
  outcome.readings = mean_of(of_sides);
  for (const Reading& reading : after_drops.all()) outcome.readings.set(reading.name, reading.value);
  return outcome;
}

}  // namespace pastefit
