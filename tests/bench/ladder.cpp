#include "tests/bench/ladder.h"

#include <cmath>
#include <ctime>

#include "core/apparatus/slump/packing.h"

namespace pastefit {

namespace {

Mean mean_of(const std::vector<double>& values) {
  Mean mean;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) mean.value += v / n;
  if (values.size() < 2) return mean;
  double square = 0;
  for (const double v : values) square += (v - mean.value) * (v - mean.value);
  mean.error = std::sqrt(square / (n - 1) / n);
  return mean;
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The smallest step that this scene asks for: of the first packing, at the engine's own step.
double advised_step(const SlumpTest& test, const RunOptions& options) {
  return simulate(test, options).run.advised_step_s;
}

}  // namespace

Mean reading_of(const Row& row, std::size_t reading) {
  std::vector<double> values;
  for (const Run& run : row.runs)
    if (run.readings) values.push_back((*run.readings)[reading]);
  return mean_of(values);
}

Mean cpu_of(const Row& row) {
  std::vector<double> finished, all;
  for (const Run& run : row.runs) {
    all.push_back(run.cpu_s);
    if (run.readings) finished.push_back(run.cpu_s);
  }
  return mean_of(finished.empty() ? all : finished);
}

Deviation deviation(const Row& row, const Row& reference, std::size_t reading) {
  if (row.setting.radius_m == reference.setting.radius_m) {
    std::vector<double> differences;
    for (const Run& run : row.runs)
      for (const Run& other : reference.runs)
        if (run.packing_seed == other.packing_seed && run.readings && other.readings)
          differences.push_back((*run.readings)[reading] - (*other.readings)[reading]);
    const Mean mean = mean_of(differences);
    return {mean.value, mean.error};
  }
  const Mean here = reading_of(row, reading), there = reading_of(reference, reading);
  return {here.value - there.value, std::hypot(here.error, there.error)};
}

const Row& reference_of(const std::vector<Row>& rows, const Row& row) {
  for (const Row& other : rows)
    if (other.setting.reference && other.setting.scene == row.setting.scene &&
        other.setting.ladder == row.setting.ladder)
      return other;
  return row;
}

SlumpTest front_scene(const std::string& scene, double radius_m) {
  SlumpTest test;
  test.grains.radius_m = radius_m;
  test.lift_velocity_m_s = 0.2;
  test.drop = DropPlate{};
  test.contact.friction = 0.15;
  test.contact.rolling_friction = 0.02;
  test.contact.friction_basis = FrictionBasis::total;
  if (scene == "dry") return test;
  const double strength = scene == "weak" ? 1000 : scene == "strong" ? 6000 : 2500;  // c/R^2 [Pa]
  constexpr double kRuptureShare = 0.2;                                              // force at rupture over c
  Bridge& bridge = test.contact.bridge;
  bridge.shape = BridgeShape::polynomial;
  bridge.c_n = strength * radius_m * radius_m;
  bridge.d_c_m = -0.8 * radius_m;
  bridge.b_n_m = (1 - kRuptureShare) * bridge.c_n / -bridge.d_c_m;
  bridge.offset_m = 0.4 * radius_m;
  return test;
}

std::vector<Setting> ladders(bool quick) {
  struct Size {
    const char* name;
    double radius_m;
    int packings;
  };
  const std::vector<Size> sizes =
      quick ? std::vector<Size>{{"12 mm", 0.012, 3}, {"10 mm", 0.010, 3}}
            : std::vector<Size>{
                  {"10 mm", 0.010, 8}, {"8 mm", 0.008, 8}, {"6 mm", 0.006, 5}, {"5 mm", 0.005, 4}, {"4 mm", 0.004, 3}};
  const double radius = sizes[0].radius_m;
  const int packings = quick ? 3 : 24;
  std::vector<Setting> all;
  for (const char* scene : {"dry", "cohesive"}) {
    all.push_back({scene, "step", "fixed, 1/4 of advised", radius, 0.25, packings, true});
    if (!quick) all.push_back({scene, "step", "fixed, 1/2 of advised", radius, 0.5, packings});
    all.push_back({scene, "step", "fixed, advised", radius, 1.0, packings});
    all.push_back({scene, "step", "the engine's own", radius, {}, packings});
    all.push_back({scene, "step", "fixed, 2 x advised", radius, 2.0, packings});
    if (!quick) all.push_back({scene, "step", "fixed, 4 x advised", radius, 4.0, packings});
  }
  const auto resting = [](double times) {
    RunOptions run;
    run.rest.speed_over_fall *= times;
    run.rest.change_over_radius *= times;
    return run;
  };
  RunOptions fine = resting(0.2), coarse, own, fixed;
  fine.steps.impact_resolution = 40;
  fine.steps.safety = 0.4;
  coarse.steps.impact_resolution = 9;
  own.own_fill = true;
  fixed.fixed_wait_s = 2;
  for (const char* scene : {"dry", "cohesive"}) {
    if (quick) break;
    all.push_back({scene, "shortcuts", "40 steps an impact, rest at a fifth", radius, {}, packings, true, fine});
    all.push_back({scene, "shortcuts", "fixed waits of 2 s", radius, {}, packings, false, fixed});
    all.push_back({scene, "shortcuts", "rest at a third", radius, {}, packings, false, resting(1.0 / 3)});
    all.push_back({scene, "shortcuts", "the defaults", radius, {}, packings});
    all.push_back({scene, "shortcuts", "rest at three times", radius, {}, packings, false, resting(3)});
    all.push_back({scene, "shortcuts", "9 steps an impact", radius, {}, packings, false, coarse});
  }
  for (const char* scene : kScenes) {
    if (quick) break;
    all.push_back({scene, "fill", "own fill", radius, {}, packings, true, own});
    all.push_back({scene, "fill", "shared fill", radius, {}, packings});
  }
  for (const char* scene : kScenes) {
    if (quick) break;
    all.push_back({scene, "raise", "2 s", radius, {}, packings, true, {}, 2.0});
    all.push_back({scene, "raise", "1 s", radius, {}, packings, false, {}, 1.0});
    all.push_back({scene, "raise", "0.5 s", radius, {}, packings, false, {}, 0.5});
    all.push_back({scene, "raise", "0.25 s", radius, {}, packings, false, {}, 0.25});
    all.push_back({scene, "raise", "0.125 s", radius, {}, packings, false, {}, 0.125});
  }
  // From coarse to fine, so that a run cut short has what is cheap. The finest is the reference.
  for (const Size& size : sizes)
    for (const char* scene : {"dry", "cohesive"})
      all.push_back({scene, "grains", size.name, size.radius_m, {}, size.packings, &size == &sizes.back()});
  return all;
}

Row measure(const Setting& setting, Fills& fills) {
  Row row{setting, {}};
  SlumpTest test = front_scene(setting.scene, setting.radius_m);
  if (setting.raise_s) test.drop->lift_duration_s = *setting.raise_s;
  std::optional<double> fixed_step;
  for (int n = 0; n < setting.packings; ++n) {
    Run run;
    run.packing_seed = test.packing_seed = static_cast<std::uint64_t>(n) + 1;
    RunOptions options = setting.run;
    if (!options.own_fill) {
      std::shared_ptr<const Packing>& fill = fills[{setting.radius_m, run.packing_seed, filling_of(test)}];
      if (!fill) fill = fill_mould(test);
      options.packing = fill;
    }
    if (setting.step_share && !fixed_step) fixed_step = *setting.step_share * advised_step(test, options);
    options.steps.fixed_step_s = fixed_step;
    const double start = cpu_seconds();
    const Outcome outcome = simulate(test, options);
    run.cpu_s = cpu_seconds() - start;
    run.time_step_s = outcome.run.time_step_s;
    run.energy_error = outcome.run.energy_error.value_or(0);
    if (outcome.failure) {
      run.failure = name_of(outcome.failure->reason);
    } else {
      run.readings.emplace();
      for (std::size_t k = 0; k < kReadings.size(); ++k)
        (*run.readings)[k] = outcome.readings.find(kReadings[k]).value_or(NAN);
    }
    row.runs.push_back(run);
  }
  return row;
}

}  // namespace pastefit
