#include "tests/stability/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <memory>
#include <numbers>
#include <vector>

#include "calibrate/laboratory/engine.h"
#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

// A valid run may have created this share of the energy put in: the engine's own promise (core/step/README.md).
constexpr double kCreated = 0.05;
constexpr double kGround = 0.1;  // depth of the ground below the table [m]

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// RunRecordings at the grains while the test runs: what the engine should have noticed itself.
class Witness {
 public:
  explicit Witness(const StressCase& stress) : stress_(stress) {}

  void look(const Snapshot& snapshot) {
    if (!complaint_.empty()) return;
    const Particles& grains = snapshot.world->particles;
    const bool filling = snapshot.phase.starts_with("fill");
    if (!filling && count_ == 0) {
      count_ = grains.count();
      over_rim_.resize(count_);
    }
    if (!filling && grains.count() != count_) return complain(snapshot, "the number of grains changed");
    for (std::int32_t i = 0; i < grains.count(); ++i) {
      const Motion& grain = grains.motion[i];
      if (!std::isfinite(norm(grain.position)))
        return complain(snapshot, "a position is not a number", grains.identity[i]);
      if (grain.position.z < (filling ? 0 : -kGround))
        return complain(snapshot, "a grain's centre is below the floor or ground", grains.identity[i]);
      if (filling) continue;
      // What is squeezed out over the rim may run down outside.
      const auto who = static_cast<std::size_t>(grains.identity[i]);
      if (grain.position.z > stress_.test.mould.height_m - 3 * grain.radius) over_rim_[who] = true;
      if (snapshot.phase == "step1.relax" && !over_rim_[who] && outside_mould(grain.position))
        return complain(snapshot, "a grain's centre is outside the standing mould", grains.identity[i]);
    }
  }

  const std::string& complaint() const { return complaint_; }

 private:
  bool outside_mould(const Vec3& p) const {
    const Mould& mould = stress_.test.mould;
    if (p.z > mould.height_m) return false;
    const double inner =
        mould.base_radius_m + std::max(p.z, 0.0) / mould.height_m * (mould.top_radius_m - mould.base_radius_m);
    return p.x * p.x + p.y * p.y > inner * inner;
  }

  void complain(const Snapshot& snapshot, const char* what, std::int32_t grain = -1) {
    complaint_ = std::string(what) + " (" + std::string(snapshot.phase) + ", t = " + number(snapshot.time_s) +
                 " s, grain " + std::to_string(grain) + ")";
  }

  const StressCase& stress_;
  std::int32_t count_ = 0;
  std::vector<bool> over_rim_;  // by identity
  std::string complaint_;
};

/// Where readings are not what a laboratory can read, or contradict each other; empty if nowhere. Of a heap that was
/// struck off, by the same table that laboratory files are held against.
std::string contradiction_in(const Readings& readings, const SlumpTest& test) {
  constexpr double kRounding = 1e-9;
  for (const ReadingKind& kind : reading_kinds(test)) {
    const auto value = kind.name == kind.measure ? readings.find(kind.name) : std::nullopt;
    if (!value) continue;
    const auto [possible, highest] = kind.possible;
    // Coarse grains do not fill the rim of the mould: a gap of less than a diameter on each side takes no further
    // grain.
    const bool is_width = kind.name.find("spread") != std::string_view::npos;
    const double lowest = possible - (is_width ? 4e3 * test.grains.largest_m : 0);
    if (*value < lowest - kRounding || *value > highest + kRounding)
      return std::string(kind.name) + " = " + number(*value) + " is not between " + number(lowest) + " and " +
             number(highest);
    for (const Ceiling& ceiling : kind.ceilings) {
      const bool of_one_heap = ceiling.name.substr(0, 5) == kind.name.substr(0, 5);
      const auto bound = of_one_heap ? readings.find(ceiling.name) : std::nullopt;
      if (bound && *value > *bound + kRounding)
        return std::string(kind.name) + " = " + number(*value) + " is above " + std::string(ceiling.name) + " = " +
               number(*bound);
    }
  }
  return {};
}

/// What is wrong with the readings of a run without a failure; empty if nothing is.
std::string fault_of(const Outcome& outcome, const StressCase& stress) {
  const SlumpTest& test = stress.test;
  const double tall = 1e3 * test.mould.height_m, radius = 1e3 * test.grains.largest_m;
  const double diagonal = 1e3 * std::numbers::sqrt2 * test.table_length_m;
  const std::vector<std::string> names = reading_names(test);
  const double squeezed = filling_of(test).resting_overlap;
  // Where one of two drops has left nothing on the plate there is no heap to read.
  const bool left_the_table = outcome.readings.find("step2.spilled_share").value_or(0) >= 0.5;
  if (outcome.readings.all().size() != names.size() && !left_the_table) return "readings are missing";
  for (const Reading& reading : outcome.readings.all()) {
    const auto within = [&](double lower, double upper) { return reading.value >= lower && reading.value <= upper; };
    const auto named = [&](const char* part) { return reading.name.find(part) != std::string::npos; };
    bool right = std::isfinite(reading.value);
    // Grains that start in overlap push the heap up; a third of the mould's height is more than any was seen to do.
    if (named("height")) right = right && within(-1e-3, 1.33 * tall + radius);
    if (named("slump")) right = right && within(-0.33 * tall - radius, tall + 1e-3);
    if (named("spread")) right = right && within(0, diagonal + 2 * radius);
    if (named("spilled")) right = right && within(0, 1);
    if (named("plateau_sag")) right = right && within(-2 * tall, 2 * tall);
    if (named("plateau_width")) right = right && within(0, diagonal);
    if (named("mass"))
      right = right && std::fabs(reading.value / (test.bulk_density_kg_m3 * volume_m3(test.mould)) - 1) < 1e-9;
    if (named("solid_fraction"))
      right = right && within(0.4, 0.75 * std::pow((1 + stress.enlarged) * (1 + squeezed), 3));
    if (!right) return reading.name + " = " + number(reading.value) + " is out of range";
  }
  if (stress.enlarged == 0)
    if (const std::string contradiction = contradiction_in(outcome.readings, test); !contradiction.empty())
      return contradiction;
  if (!(outcome.run.energy_error.value() < kCreated))
    return "energy created: " + number(outcome.run.energy_error.value());
  return {};
}

/// The filled mould, its grains grown: every contact starts in overlap.
std::shared_ptr<const Packing> grown(const Packing& packing, double share) {
  auto result = std::make_shared<Packing>(packing);
  for (double& radius : result->radii) radius *= 1 + share;
  result->solid_volume_m3 *= std::pow(1 + share, 3);
  return result;
}

void judge_run(const StressCase& stress, const Bounds& bounds, StressVerdict& verdict) {
  const auto defect = [&](std::string message) {
    verdict.end = "defect";
    verdict.message = std::move(message);
  };
  Faults faults = validate(stress.test);
  if (stress.searched) std::erase_if(faults, [](const Fault& one) { return one.where == "contact.youngs_modulus_pa"; });
  if (!faults.empty()) return defect("an admissible test has faults: " + faults[0].where + " " + faults[0].what);
  const double start = cpu_seconds();
  Witness witness(stress);
  RunOptions options;
  options.step_limit = bounds.steps;
  options.pulse = [&](const Snapshot&) { return cpu_seconds() - start < bounds.cpu_s; };
  options.watch = [&](const Snapshot& snapshot) {
    witness.look(snapshot);
    return options.pulse(snapshot);
  };
  if (const auto failure = stress.searched ? too_soft(stress.test, options) : std::nullopt) {
    verdict.end = name_of(failure->reason);
    verdict.phase = failure->phase;
    verdict.message = failure->message;
    return;
  }
  if (stress.enlarged > 0) {
    options.packing = fill_mould(stress.test, options);
    if (!options.packing->failure) options.packing = grown(*options.packing, stress.enlarged);
  }
  const Outcome outcome = simulate(stress.test, options);
  verdict.particles = outcome.run.particles;
  verdict.steps = outcome.run.steps;
  verdict.simulated_s = outcome.run.simulated_s;
  verdict.energy_error = outcome.run.energy_error.value_or(0);
  verdict.settled = outcome.run.settled;
  if (outcome.failure) {
    verdict.end = name_of(outcome.failure->reason);
    verdict.phase = outcome.failure->phase;
    verdict.message = outcome.failure->message;
    if (stress.keeps_energy && outcome.failure->reason == FailureReason::energy_created)
      defect("energy created: " + number(outcome.failure->value) + " in " + verdict.phase);
    if (verdict.phase.empty() || verdict.message.empty()) defect(verdict.end + " without phase or message");
  } else if (const std::string fault = fault_of(outcome, stress); !fault.empty()) {
    defect(fault);
  } else {
    verdict.end = "valid";
    verdict.height1_mm = *outcome.readings.find("step1.height_mm");
    verdict.height2_mm = outcome.readings.find("step2.height_mm").value_or(0);
    verdict.spread_mm = *outcome.readings.find("step1.spread_mm");
  }
  if (!witness.complaint().empty()) defect(verdict.end + ", but " + witness.complaint());
}

}  // namespace

StressVerdict judge(const StressCase& stress, const Bounds& bounds) {
  StressVerdict verdict;
  const double start = cpu_seconds();
  try {
    judge_run(stress, bounds, verdict);
  } catch (const std::exception& error) {
    verdict.end = "defect";
    verdict.message = std::string("exception: ") + error.what();
  }
  verdict.cpu_s = cpu_seconds() - start;
  return verdict;
}

}  // namespace pastefit
