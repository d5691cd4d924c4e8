#include "calibrate/cli/single_run.h"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/store/outcome_json.h"
#include "core/step/state.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

/// What a picture is made of, each a series of its own: the name of that of the grains, and what is added to it.
constexpr std::array<std::string_view, 3> kLayers{"", "-links", "-walls"};

std::vector<std::string> names_of_stages(const Scene& scene) {
  const auto* test = std::get_if<Test>(&scene);
  if (!test) return {"grains"};
  const auto names = series_of(*test);
  return {names.begin(), names.end()};
}

std::size_t stage_of(const Scene& scene, const Snapshot& snapshot) {
  const auto* test = std::get_if<Test>(&scene);
  return test ? series_at(*test, snapshot) : 0;
}

}  // namespace

RunPictures::RunPictures(const std::filesystem::path& folder, const Scene& scene) : scene_(scene) {
  for (const std::string& name : names_of_stages(scene)) {
    Stage& stage = stages_.emplace_back();
    for (const std::string_view layer : kLayers) stage.layers.emplace_back(folder, name + std::string(layer));
  }
}

std::vector<std::string> RunPictures::index_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const std::string& name : names_of_stages(scene))
    for (const std::string_view layer : kLayers) names.push_back(name + std::string(layer) + ".pvd");
  return names;
}

Faults RunPictures::add(const Snapshot& snapshot) {
  Stage& stage = stages_.at(stage_of(scene_, snapshot));
  // A stage may be several runs, one after the other.
  if (snapshot.time_s < stage.last_s) stage.earlier_s += stage.last_s;
  stage.last_s = snapshot.time_s;
  stage.begun = true;
  const World& world = *snapshot.world;
  const std::array<VtkFrame, kLayers.size()> frames{grain_frame(world), link_frame(world), wall_frame(world)};
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (auto faults = stage.layers[i].add(snapshot.time_s + stage.earlier_s, frames[i]); !faults.empty()) return faults;
  return {};
}

std::vector<std::filesystem::path> RunPictures::indices() const {
  std::vector<std::filesystem::path> files;
  for (const Stage& stage : stages_)
    for (const VtkSeries& layer : stage.layers)
      if (stage.begun) files.push_back(layer.index());
  return files;
}

Result<std::shared_ptr<RunCheckpoint>> SavedRun::checkpoint() {
  try {
    return std::make_shared<RunCheckpoint>([this] { return stop_ || Clock::now() > next_; },
                                           [this](const std::string& state) { keep(state); },
                                           std::exchange(found_.bytes, {}));
  } catch (const BadState& bad) {
    return file_.no_state_of_this_run(bad.what());
  }
}

Result<Outcome> SavedRun::simulate(const Scene& scene, const RunOptions& run) const {
  try {
    Outcome outcome = pastefit::simulate(scene, run);
    if (run.checkpoint->is_told()) return outcome;
    return file_.no_state_of_this_run("it holds more than this run has");
  } catch (const BadState& bad) {
    return file_.no_state_of_this_run(bad.what());
  }
}

void SavedRun::keep(const std::string& state) {
  unwritten_ = file_.write({state, wall_s()});
  next_ = Clock::now() + kBetween;
}

namespace {

nlohmann::ordered_json outlines_json(const std::map<std::string_view, Outline>& outlines) {
  auto out = nlohmann::ordered_json::object();
  for (const auto& [name, side] : outlines) {
    auto& points = out[std::string(name)] = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < side.height_m.size(); ++k)
      points.push_back({1e3 * (side.first_x_m + static_cast<double>(k) * side.spacing_m), 1e3 * side.height_m[k]});
  }
  return out;
}

}  // namespace

std::string simulation_json(const Outcome& outcome, const Test* test,
                            const std::map<std::string_view, Outline>& outlines, double wall_s) {
  const auto& run = outcome.run;
  nlohmann::ordered_json out;
  out["observables"] = to_json(outcome.readings);
  if (test && !outcome.failure)
    if (auto stresses = yield_stresses_json(*test, outcome.readings); !stresses.empty())
      out["yield_stress_pa"] = std::move(stresses);
  if (!outlines.empty()) out["outlines_mm"] = outlines_json(outlines);
  out["run"] = {{"particles", run.particles},
                {"steps", run.steps},
                {"time_step_s", run.time_step_s},
                {"advised_step_s", run.advised_step_s},
                {"energy_error", run.energy_error ? nlohmann::ordered_json(*run.energy_error) : nullptr},
                {"simulated_s", run.simulated_s},
                {"wall_s", wall_s},
                {"particle_steps_per_s", wall_s > 0 ? static_cast<double>(run.particle_steps) / wall_s : 0},
                {"settled", run.settled},
                {"failure", to_json(outcome.failure)}};
  return json_text(out);
}

void print_simulation(const Outcome& outcome, double wall_s, bool packed) {
  for (const auto& [name, value] : outcome.readings.all()) print("%-26s %12.6g\n", name.c_str(), value);
  if (packed && !outcome.failure) print("One packing, error unknown: other packings (--seed) read differently.\n");
  const auto& run = outcome.run;
  print("%lld grain%s, %lld steps of %.3g s, %.3g s simulated in %.3g s (%.3g million\nparticle-steps a second)%s\n",
        static_cast<long long>(run.particles), run.particles == 1 ? "" : "s", static_cast<long long>(run.steps),
        run.time_step_s, run.simulated_s, wall_s, static_cast<double>(run.particle_steps) / wall_s / 1e6,
        run.settled || outcome.failure ? "" : "; not quite at rest when its time was over");
}

std::string csv_of(const Curve& curve) {
  std::string out = curve.x + "," + curve.y + "\n";
  for (const CurvePoint& point : curve.points) out += format("%.6g,%.6g\n", point.x, point.y);
  return out;
}

void judge_step(double given_s, double advised_s) {
  if (given_s <= advised_s)
    note("pastefit: the time step %.3g s is within the advised %.3g s\n", given_s, advised_s);
  else
    note(
        "pastefit: the time step %.3g s exceeds the advised %.3g s: the result may be wrong; leave --time-step out, or "
        "give at most that\n",
        given_s, advised_s);
}

void print_failure(const Failure& failure) {
  std::fprintf(stderr, "pastefit: the simulation failed: %s in %s at %.4g s (step %lld): %s\n",
               std::string(name_of(failure.reason)).c_str(), failure.phase.c_str(), failure.time_s,
               static_cast<long long>(failure.step), failure.message.c_str());
}

}  // namespace pastefit
