// A calibration like that of `pastefit calibrate`, of a toy instead of the engine: what the kill test kills.
// usage: toy-calibration STUDY DIR
// Prints "known N simulated M": evaluations found in the store, and those made by this process.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "calibrate/base/atomic_file.h"
#include "calibrate/calibrate.h"
#include "calibrate/card/calibration_card.h"
#include "calibrate/inference/description.h"
#include "core/random.h"
#include "tests/calibrate/slump.h"

using namespace pastefit;

namespace {

/// A slump in closed form: the height rises with the strength, the packing and the digits of the bridge make the noise.
/// It takes between 1 and 3 ms, and is as reproducible as the engine.
Outcome toy_slump(const SlumpTest& test, const RunOptions&) {
  const Bridge& bridge = test.contact.bridge;
  const double drive = std::log(bridge.c_n / 0.1) - 20 * bridge.d_c_m - 1e-5 * bridge.a_n_m2;
  const RandomStream random(test.packing_seed, "toy");
  const auto digits = static_cast<std::uint64_t>(1e12 * bridge.c_n + 1e15 * bridge.offset_m);
  const double height = 300 / (1 + std::exp(-drive)) + 4 * random.normal(digits);
  Outcome outcome;
  outcome.readings.set("fill.mass_kg", 12.3);
  outcome.readings.set("fill.solid_fraction", 0.59);
  outcome.readings.set("step1.height_mm", std::clamp(height, 0.0, 300.0));
  outcome.readings.set("step1.spread_mm", 600 - height);
  outcome.readings.set("step1.lateral_shift_mm", 0);
  outcome.run.particles = 1;
  outcome.run.settled = true;
  if (random.uniform(digits) < 0.05)
    outcome.failure = Failure{FailureReason::grain_lost, "step1.lift", 10, 0.1, 0, 0, 0, "Toy."};
  std::this_thread::sleep_for(std::chrono::microseconds(1000 + 2000 * (digits % 100) / 100));
  return outcome;
}

int fail(const Faults& faults) {
  for (const Fault& fault : faults)
    std::fprintf(stderr, "%s: %s; %s\n", fault.where.c_str(), fault.what.c_str(), fault.remedy.c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto read = read_study(argv[1]);
  if (!read.ok()) return fail(read.faults());
  const Study& study = read.value();
  const std::string folder = argv[2];
  auto store = Store::open(folder + "/evaluations.sqlite", {"toy", inputs_of(study)});
  if (!store.ok()) return fail(store.faults());

  PoolOptions options;
  options.threads = 2;
  options.engine.prepare = [](const Test&, const RunOptions&) { return std::shared_ptr<const Packing>(); };
  options.engine.run = of_slump(toy_slump);
  const auto known = store.value().size();
  const auto calibrated = calibrate(study, store.value(), options, {}, "study.json");
  if (!calibrated.ok()) return fail(calibrated.faults());
  const CalibrationResult& result = calibrated.value();
  if (!result.card) return 1;
  const Faults faults = write_atomically(
      folder + "/card.json", to_json(*result.card).dump(2) + (result.inference ? describe(*result.inference) : ""));
  if (!faults.empty()) return fail(faults);
  std::printf("known %zu simulated %d\n", known, result.counts.simulated);
  return 0;
}
