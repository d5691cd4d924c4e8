#include "core/step/runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/step/state_check.h"

namespace pastefit {

namespace {

double mean_speed(const Particles& particles) {
  double squares = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i)
    squares += dot(particles.velocity[i].linear, particles.velocity[i].linear);
  return std::sqrt(squares / std::max(particles.count(), 1));
}

double largest_change(const std::vector<double>& before, const std::vector<double>& now) {
  double largest = 0;
  for (std::size_t k = 0; k < now.size(); ++k) largest = std::max(largest, std::fabs(now[k] - before[k]));
  return largest;
}

// Unexplained energy over energy put in beyond which a run is invalid. At the default step the energy balance of a
// slump closes to 0.1 %, and to 0.5 % in all of the admissible box; an unstable step creates many times the energy put
// in.
constexpr double kEnergyTolerance = 0.02;
constexpr std::int64_t kStepsPerAudit = 8 * Stepper::kBalanceInterval;

// A specimen that still changes by more than this in one window has no valid readings.
constexpr double kStillFlowing = 0.1;  // of the mean radius

}  // namespace

Runner::Runner(World& world, const RunOptions& options, RestMeasure rest_measure)
    : world_(world), options_(options), rest_measure_(std::move(rest_measure)), stepper_(world, options.steps) {
  summary_.particles = world.particles.count();
  summary_.settled = true;
}

RunCheckpoint::Wait Runner::state() {
  StateWriter visible, rest;
  seen(visible);
  if (write_own_) write_own_(visible);
  hidden(rest);
  return {visible.take(), rest.take()};
}

void Runner::recall(const RunCheckpoint::Wait& left) {
  const Fixtures fixtures(world_);
  StateReader visible(left.seen), rest(left.hidden);
  seen(visible);
  if (read_own_) read_own_(visible);
  visible.end();
  fixtures.check(world_);
  demand(world_.time >= 0 && world_.step >= 0, "its clock is before the beginning");
  is_whole_ = !left.hidden.empty();
  if (!is_whole_) return;
  hidden(rest);
  rest.end();
  stepper_.check_state();
  demand(summary_.steps >= 0 && summary_.steps <= options_.step_limit && summary_.particle_steps >= 0,
         "its steps are not those of this run");
}

/// Checks that the progress read is possible for a wait of this length.
void Runner::check_progress(double longest_s, double cap_s) const {
  const double rounding = 1e-9 * (world_.time + longest_s);
  const double windows = std::round(progress_.waited / options_.rest.window_s);  // an upper bound on calm windows
  demand(progress_.end <= world_.time + longest_s + rounding && progress_.cap == cap_s && progress_.waited >= 0 &&
             progress_.waited <= cap_s && progress_.calm >= 0 && progress_.calm <= windows,
         "the wait that was under way is another one");
  demand(cap_s == 0 || progress_.before.size() == rest_measure_(world_.particles).size(),
         "the rest measure that was seen is of another specimen");
}

template <class Body>
std::optional<Failure> Runner::resumable(const Body& wait) {
  RunCheckpoint* const checkpoint = options_.checkpoint.get();
  if (!checkpoint) return wait(false);
  if (const RunCheckpoint::Wait* ended = checkpoint->next_ended()) {
    recall(*ended);
    last_ended_ = checkpoint->told() - 1;
    return {};
  }
  const auto interrupted = checkpoint->take_interrupted();
  if (interrupted) recall(*interrupted);
  demand(is_whole_, "a wait that the run goes on from left too little");
  if (auto problem = wait(interrupted.has_value())) return problem;
  last_ended_ = checkpoint->add(state(), last_ended_);
  return {};
}

PhaseLeft Runner::left(const Phase& phase) const {
  const double now = std::max(progress_.end - world_.time, 0.0);
  PhaseLeft left{now, now};
  if (progress_.cap > 0) {
    const RestCriterion& rest = options_.rest;
    // Remaining windows: those that must be calm and, as `wait_for_rest` counts them, those within the time limit.
    left.least_s += rest.window_s * std::max(0, rest.windows - progress_.calm - 1);
    left.most_s += rest.window_s * std::max(0.0, std::ceil((progress_.cap - progress_.waited) / rest.window_s) - 1);
    left.least_s = std::min(left.least_s, left.most_s);
  }
  if (phase.done) left.least_s = 0;
  return {left.least_s + phase.after.least_s, left.most_s + phase.after.most_s};
}

std::optional<Failure> Runner::tell(const Phase& phase) {
  if (stepper_.has_failed()) return {};  // the next step reports it; such a state cannot be resumed
  if (world_.step % kStepsPerPulse == 0) {
    const bool stop =
        options_.pulse && !options_.pulse({phase.name, world_.time, world_.step, &world_, 0, left(phase)});
    if (options_.checkpoint && (stop || options_.checkpoint->due())) options_.checkpoint->keep(state());
    if (stop) return stopped_in(phase.name);
  }
  if (!options_.watch || world_.time < next_watch_) return {};
  return look({phase.name, world_.time, world_.step, &world_, 0, left(phase)});
}

Failure Runner::stopped_in(std::string_view phase) const {
  return {FailureReason::stopped, std::string(phase), world_.step, world_.time, -1, 0, 0, "the run was asked to stop"};
}

std::optional<Failure> Runner::look(const Snapshot& snapshot) {
  next_watch_ = world_.time + options_.watch_interval_s;
  return options_.watch(snapshot) ? std::nullopt : std::optional(stopped_in(snapshot.phase));
}

std::optional<Failure> Runner::show(std::string_view phase) {
  if (!options_.watch) return {};
  return look({phase, world_.time, world_.step, &world_});
}

std::optional<Failure> Runner::run(const Phase& phase, double duration_s) {
  return resumable([&](bool midway) {
    if (midway)
      check_progress(duration_s, 0);
    else
      progress_ = {.end = world_.time + duration_s};
    return advance(phase);
  });
}

std::optional<Failure> Runner::advance(const Phase& phase) {
  while (world_.time < progress_.end) {
    if (auto problem = tell(phase)) return problem;
    if (auto problem = stepper_.step(phase.drive)) {
      problem->phase = phase.name;
      return problem;
    }
    ++summary_.steps;
    summary_.particle_steps += world_.particles.count();
    if (summary_.steps >= options_.step_limit)
      return Failure{FailureReason::step_limit,
                     std::string(phase.name),
                     world_.step,
                     world_.time,
                     -1,
                     static_cast<double>(summary_.steps),
                     static_cast<double>(options_.step_limit),
                     "the bound on the number of steps was reached; allow more steps or choose softer grains"};
    if (world_.step % kStepsPerAudit == 1) {
      if (auto problem = audit(phase.name)) return problem;
    }
    if (phase.done && phase.done(world_)) break;
  }
  return {};
}

double Runner::energy_error() const {
  // A heap at rest has no energy input: count at least a fall of a hundredth of a radius.
  double mass = 0;
  for (std::int32_t i = 0; i < world_.particles.count(); ++i) mass += world_.particles.mass(i);
  const double least = 0.01 * mass * kGravity * world_.reference_radius;
  const EnergyBalance& energy_balance = stepper_.energy_balance();
  return energy_balance.error() / std::max(energy_balance.put_in(), least);
}

std::optional<Failure> Runner::audit(std::string_view phase) {
  if (!options_.steps.energy_balance) return {};
  const double error = energy_error();
  if (std::fabs(error) < kEnergyTolerance) return {};
  return Failure{
      error > 0 ? FailureReason::energy_created : FailureReason::energy_lost,
      std::string(phase),
      world_.step,
      world_.time,
      -1,
      error,
      kEnergyTolerance,
      std::string(error > 0 ? "the run creates energy" : "the run loses energy that no mechanism accounts for") +
          (options_.steps.fixed_step_s
               ? ": the time step is too large for these contacts; let the program choose it, or take a "
                 "smaller one"
               : " at the time step that the program chose; fix half of it")};
}

Runner::Wait Runner::wait_for_rest(const Phase& phase, double cap_s, bool midway,
                                   const std::function<bool(const World&)>& free) {
  const RestCriterion& criterion = options_.rest;
  const double radius = world_.reference_radius;
  const double slow = criterion.speed_over_fall * std::sqrt(kGravity * radius);
  Wait wait;
  if (midway)
    check_progress(criterion.window_s, cap_s);
  else
    progress_ = {.before = rest_measure_(world_.particles), .cap = cap_s};
  for (bool begun = midway; progress_.waited < cap_s; progress_.waited += criterion.window_s, begun = false) {
    if (!begun) progress_.end = world_.time + criterion.window_s;
    wait.failure = advance(phase);
    wait.done = phase.done && phase.done(world_);
    if (wait.failure || wait.done) return wait;
    const std::vector<double> now = rest_measure_(world_.particles);
    wait.change = largest_change(progress_.before, now);
    const bool is_calm = mean_speed(world_.particles) < slow && wait.change < criterion.change_over_radius * radius;
    progress_.calm = is_calm ? progress_.calm + 1 : 0;
    wait.rested = progress_.calm >= criterion.windows;
    if (wait.rested && (!free || free(world_))) {
      progress_.rested = true;
      return wait;
    }
    progress_.before = now;
  }
  return wait;
}

std::optional<Failure> Runner::run_until_rest(const Phase& phase, double longest_s,
                                              const std::function<bool(const World&)>& free) {
  return resumable([&](bool midway) { return wait_for_rest(phase, longest_s, midway, free).failure; });
}

std::optional<Failure> Runner::settle(const Phase& phase, double cap_s, double moved_s) {
  if (options_.fixed_wait_s) return run(phase, moved_s + *options_.fixed_wait_s);
  return resumable([&](bool midway) { return settle_now(phase, moved_s + cap_s, midway); });
}

std::optional<Failure> Runner::settle_now(const Phase& phase, double cap_s, bool midway) {
  const Wait wait = wait_for_rest(phase, cap_s, midway);
  if (wait.failure || wait.rested || wait.done) return wait.failure;
  summary_.settled = false;
  const double limit = kStillFlowing * world_.reference_radius;
  if (wait.change < limit) return {};
  return Failure{
      FailureReason::never_settled,
      std::string(phase.name),
      world_.step,
      world_.time,
      -1,
      wait.change,
      limit,
      "the specimen still moved when the time allowed was over; raise friction, rolling friction or strength"};
}

const RunSummary& Runner::summary() {
  summary_.simulated_s = world_.time;
  if (options_.steps.energy_balance) summary_.energy_error = energy_error();
  summary_.advised_step_s = stepper_.smallest_advised_step();
  summary_.time_step_s = summary_.steps > 0 ? world_.time / static_cast<double>(summary_.steps) : 0;
  return summary_;
}

}  // namespace pastefit
