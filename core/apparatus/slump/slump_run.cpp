#include <algorithm>
#include <cmath>

#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/plate_drop.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/apparatus/slump/spread_series.h"
#include "core/apparatus/slump/tilt.h"
#include "core/observe/heap.h"
#include "core/step/runner.h"

namespace pastefit {

namespace {

constexpr int kStepsPerLook = 64;  // between two checks of the highest point
// [radii] Largest possible rise of a lost heap: dragged by the mould, oscillating, or a hopping grain. Twice the
// largest rise observed (tests/results/skipping.md).
constexpr double kRebound = 1;

/// Step 1, one function per phase.
class MouldLift {
 public:
  MouldLift(const SlumpTest& test, const Packing& filled, const RunOptions& options)
      : test_(test),
        options_(options),
        world_(world_in_mould(test, filled)),
        runner_(world_, options, rest_measure_of_heap),
        ruler_(test, filled.roughness_m, world_.particles) {
    if (is_timed(test)) runner_.remember([this] { return spreads_.is_sound(); }, spreads_);
    if (options_.cutoff)
      lost_below_ = 1e-3 * options_.cutoff->lowest - ruler_.above_highest_m() - kRebound * test_.grains.radius_m;
  }

  std::optional<Failure> run() {
    if (auto problem = lift_mould()) return problem;
    if (lost()) return {};
    if (auto problem = rest_on_table()) return problem;
    return runner_.show("step1.rest");
  }

  /// True if step 1 is certain to read less than the cutoff: the highest point plus the roughness of the packing is a
  /// grain radius below it. No height exceeds this sum, and a heap only sinks, except for oscillations, hopping grains,
  /// and drag by the mould (less than half a radius, tests/results/skipping.md).
  bool lost() const { return lost_below_ > 0 && highest_point(world_.particles) < lost_below_; }

  /// True if the reading of step 1 is outside the cutoff.
  bool is_unwanted(const Readings& readings) const {
    if (!options_.cutoff) return false;
    const double height_mm = readings.find(options_.cutoff->reading).value_or(0);
    return height_mm < options_.cutoff->lowest || height_mm > options_.cutoff->highest;
  }

  const SpreadSeries& spreads() const { return spreads_; }
  const World& world() const { return world_; }
  const Ruler& ruler() const { return ruler_; }
  const EnergyBalance& energy_balance() const { return runner_.energy_balance(); }
  const RunSummary& summary() { return runner_.summary(); }

 private:
  /// The lift ends when the mould is above the heap, or when it touches nothing and the heap is at rest, because then
  /// nothing can move any more. With fixed waits it ends after a rise by the height of the mould.
  std::optional<Failure> lift_mould() {
    Wall& mould = world_.walls[kMould];
    mould.velocity = {0, 0, test_.lift_velocity_m_s};
    const auto clear = [&](const World& world) {
      return world.step % kStepsPerLook == 0 &&
             (std::get<Shell>(mould.shape).base.z > highest_point(world.particles) || lost());
    };
    const auto untouched = [&](const World&) { return norm(mould.force) == 0; };
    const double rise_s = test_.mould.height_m / test_.lift_velocity_m_s;
    auto problem = options_.fixed_wait_s
                       ? runner_.run({"step1.lift", time_flow(), look_whether_lost()}, rise_s)
                       : runner_.run_until_rest({"step1.lift", time_flow(), clear}, 1.5 * rise_s, untouched);
    if (problem) return problem;
    const double rim_m = std::get<Shell>(mould.shape).base.z;
    const bool holds = norm(mould.force) > 0;
    rests_ = runner_.rests();
    runner_.take_away_last_wall();
    return holds && highest_point(world_.particles) > rim_m ? let_down(rim_m) : std::nullopt;
  }

  /// A heap that hangs in the lifted mould (inverted or sticky) is let down at the lift speed, as if shaken out: a free
  /// fall would crush it.
  std::optional<Failure> let_down(double height_m) {
    world_.drag = kGravity / test_.lift_velocity_m_s;
    auto problem =
        runner_.run({"step1.let_down", time_flow(), look_whether_lost()}, height_m / test_.lift_velocity_m_s);
    world_.drag = 0;
    runner_.changed();
    return problem;
  }

  /// The heap comes to rest on the table, unless it already is at rest, or is lost.
  std::optional<Failure> rest_on_table() {
    if (rests_) return {};
    return runner_.settle({"step1.rest", time_flow(), look_whether_lost()}, kRestCap);
  }

  std::function<bool(const World&)> look_whether_lost() const {
    if (!options_.cutoff) return {};
    return [this](const World& world) { return world.step % kStepsPerLook == 0 && lost(); };
  }

  /// Records the spread, if a reading needs it; does not change the world.
  std::function<void(World&, double)> time_flow() {
    if (!is_timed(test_)) return {};
    return [this](World& world, double) { spreads_.take(world, test_.grains.radius_m); };
  }

  const SlumpTest& test_;
  const RunOptions& options_;
  World world_;
  Runner runner_;
  Ruler ruler_;
  SpreadSeries spreads_;
  bool rests_ = false;     ///< at rest without contact to the mould before its removal
  double lost_below_ = 0;  ///< highest point [m]
};

/// Times of the flow, and spread against time.
void read_times(const SlumpTest& test, const MouldLift& lift, Outcome& outcome) {
  const SpreadSeries& spreads = lift.spreads();
  outcome.curve = spreads.curve();
  if (const auto& flow = test.reading.flow) {
    // Absent if the heap never was this wide.
    if (const auto time = spreads.time_to(flow->diameter_m)) outcome.readings.set("step1.t500_s", *time);
    outcome.readings.set("step1.flow_time_s", spreads.time_of_flow());
  }
  if (!test.reading.spread_curve.empty())
    outcome.readings.set("step1.spread_curve_mm", 1e3 * spreads.rms_difference(test.reading.spread_curve));
}

void add_up(RunSummary& sum, const RunSummary& part) {
  sum.steps += part.steps;
  sum.particle_steps += part.particle_steps;
}

/// Summary of the lift and of the drops, or the tilt, after it.
RunSummary together(RunSummary lift, const RunSummary& drops) {
  lift.simulated_s += drops.simulated_s;
  lift.advised_step_s = std::min(lift.advised_step_s, drops.advised_step_s);
  lift.settled = lift.settled && drops.settled;
  lift.energy_error = drops.energy_error;
  add_up(lift, drops);
  lift.time_step_s = lift.simulated_s / static_cast<double>(lift.steps);
  return lift;
}

}  // namespace

Outcome simulate(const SlumpTest& test, const RunOptions& options) {
  Outcome outcome;
  const std::shared_ptr<const Packing> packing = options.packing ? options.packing : fill_mould(test, options);
  outcome.run = packing->run;
  outcome.failure = packing->failure;
  if (outcome.failure) return outcome;
  const Packing filled = full_mould(test, *packing, options);
  outcome.run = filled.run;
  outcome.failure = filled.failure;
  if (outcome.failure) return outcome;

  outcome.readings.set("fill.mass_kg", test.bulk_density_kg_m3 * volume_m3(test.mould));
  outcome.readings.set("fill.solid_fraction", filled.solid_volume_m3 / volume_m3(test.mould));
  MouldLift lift(test, filled, options);
  outcome.failure = lift.run();
  outcome.run = lift.summary();
  bool ended_early = lift.lost();
  if (!outcome.failure && !ended_early) {
    lift.ruler().read(lift.world().particles, "step1", outcome.readings);
    if (is_timed(test)) read_times(test, lift, outcome);
    ended_early = lift.is_unwanted(outcome.readings);
  }
  if ((test.drop || test.tilt) && !outcome.failure && !ended_early) {
    Outcome after = test.drop ? drop_plate(test, lift.world(), lift.ruler(), lift.energy_balance(), options)
                              : tilt_table(test, lift.world(), lift.energy_balance(), options);
    outcome.failure = after.failure;
    outcome.run = together(outcome.run, after.run);
    for (const Reading& reading : after.readings.all()) outcome.readings.set(reading.name, reading.value);
    if (after.curve) {
      after.curve->points.insert(after.curve->points.begin(),
                                 {0, outcome.readings.find("step1.spread_mm").value_or(0)});
      outcome.curve = std::move(after.curve);
    }
  }
  outcome.run.ended_early = ended_early;
  if (options.fixed_wait_s) outcome.run.settled = false;  // not checked
  if (!options.packing) add_up(outcome.run, packing->run);
  add_up(outcome.run, filled.run);
  return outcome;
}

}  // namespace pastefit
