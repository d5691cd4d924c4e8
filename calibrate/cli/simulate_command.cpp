#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/fault_text.h"
#include "calibrate/base/foreign_text.h"
#include "calibrate/base/format.h"
#include "calibrate/card/scene.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/effort_checks.h"
#include "calibrate/cli/interrupt.h"
#include "calibrate/cli/machine_options.h"
#include "calibrate/cli/option_checks.h"
#include "calibrate/cli/output_file.h"
#include "calibrate/cli/sign_of_life.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/cli/understood.h"
#include "calibrate/report/vtk.h"
#include "calibrate/search/effort.h"
#include "calibrate/search/memory.h"
#include "calibrate/store/checkpoint.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/store/output_folder.h"
#include "core/observe/outline.h"
#include "core/step/run_checkpoint.h"
#include "core/step/state.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

struct SimulateOptions {
  std::string file;
  std::vector<std::string> settings;
  std::string test;
  std::optional<std::uint64_t> seed;
  std::string out;
  std::string checkpoint;
  bool force = false;
  bool json = false;
  std::optional<double> vtk_interval_s;
  std::optional<double> time_step_s;
  int threads = 1;
};

const std::string kResult = "outcome.json";
const std::string kCurve = "curve.csv";

/// The ParaView series that a scene may be shown in, and the one that a moment of it belongs to.
std::vector<std::string> names_of_series(const Scene& scene) {
  const auto* test = std::get_if<Test>(&scene);
  if (!test) return {"grains"};
  const auto names = series_of(*test);
  return {names.begin(), names.end()};
}

std::size_t series_in(const Scene& scene, const Snapshot& snapshot) {
  const auto* test = std::get_if<Test>(&scene);
  return test ? series_at(*test, snapshot) : 0;
}

/// What a picture is made of, each a series of its own: the name of that of the grains, and what is added to it.
constexpr std::array<std::string_view, 3> kLayers{"", "-links", "-walls"};

/// Pictures of a run in series, each with one clock that starts where its first moment says.
class Pictures {
 public:
  Pictures(const std::filesystem::path& folder, const std::vector<std::string>& series) {
    for (const std::string& name : series) {
      Shown& scene = scenes_.emplace_back();
      for (const std::string_view layer : kLayers) scene.layers.emplace_back(folder, name + std::string(layer));
    }
  }

  Faults add(const Snapshot& snapshot, std::size_t series) {
    Shown& scene = scenes_.at(series);
    // A stage may be several runs, one after the other.
    if (snapshot.time_s < scene.last_s) scene.earlier_s += scene.last_s;
    scene.last_s = snapshot.time_s;
    scene.begun = true;
    const World& world = *snapshot.world;
    const std::array<std::string, 3> files{vtp_of(grain_frame(world)), vtp_of(link_frame(world)),
                                           vtp_of(wall_frame(world))};
    for (std::size_t i = 0; i < files.size(); ++i)
      if (auto faults = scene.layers[i].add(snapshot.time_s + scene.earlier_s, files[i]); !faults.empty())
        return faults;
    return {};
  }

  std::vector<std::filesystem::path> indices() const {
    std::vector<std::filesystem::path> files;
    for (const Shown& scene : scenes_)
      for (const VtkSeries& layer : scene.layers)
        if (scene.begun) files.push_back(layer.index());
    return files;
  }

 private:
  struct Shown {
    std::vector<VtkSeries> layers;
    double last_s = 0, earlier_s = 0;
    bool begun = false;
  };

  std::vector<Shown> scenes_;
};

/// Outlines by name, as the points of a profile in a laboratory file: {"step1": [[x_mm, z_mm], ...], ...}.
nlohmann::ordered_json outlines_json(const std::map<std::string_view, Outline>& outlines) {
  auto out = nlohmann::ordered_json::object();
  for (const auto& [name, side] : outlines) {
    auto& points = out[std::string(name)] = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < side.height_m.size(); ++k)
      points.push_back({1e3 * (side.first_x_m + static_cast<double>(k) * side.spacing_m), 1e3 * side.height_m[k]});
  }
  return out;
}

nlohmann::ordered_json simulation_json(const Outcome& outcome, const nlohmann::ordered_json& outlines, double wall_s) {
  const auto& run = outcome.run;
  nlohmann::ordered_json out;
  out["observables"] = to_json(outcome.observables);
  if (!outlines.empty()) out["outlines_mm"] = outlines;
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
  return out;
}

/// One line for each point, below the names of the axes.
std::string csv_of(const Curve& curve) {
  std::string out = curve.x + "," + curve.y + "\n";
  for (const CurvePoint& point : curve.points) out += format("%.6g,%.6g\n", point.x, point.y);
  return out;
}

/// Readings, and the curve of a test that draws one.
Faults write_results(const OutputFolder& folder, const std::string& text, const Outcome& outcome) {
  folder.clear({kCurve});
  auto faults = write_atomically(folder.file(kResult), text);
  if (faults.empty() && outcome.curve) faults = write_atomically(folder.file(kCurve), csv_of(*outcome.curve));
  return faults;
}

void print_simulation(const Outcome& outcome, double wall_s, bool packed) {
  for (const auto& [name, value] : outcome.observables.all()) print("%-26s %12.6g\n", name.c_str(), value);
  if (packed && !outcome.failure) print("One packing, error unknown: other packings (--seed) read differently.\n");
  const auto& run = outcome.run;
  print("%lld grain%s, %lld steps of %.3g s, %.3g s simulated in %.3g s (%.3g million\nparticle-steps a second)%s\n",
        static_cast<long long>(run.particles), run.particles == 1 ? "" : "s", static_cast<long long>(run.steps),
        run.time_step_s, run.simulated_s, wall_s, static_cast<double>(run.particle_steps) / wall_s / 1e6,
        run.settled || outcome.failure ? "" : "; not quite at rest when its time was over");
}

/// What the program thinks of a step the user has set.
void judge_step(double given_s, double advised_s) {
  if (given_s <= advised_s)
    note("pastefit: the time step %.3g s is within the advised %.3g s\n", given_s, advised_s);
  else
    note(
        "pastefit: the time step %.3g s exceeds the advised %.3g s: the result may be wrong; leave --time-step out, or "
        "give at most that\n",
        given_s, advised_s);
}

Faults checkpoint_faults(const SimulateOptions& options, const Scene& scene) {
  if (options.checkpoint.empty()) return {};
  const auto* test = std::get_if<Test>(&scene);
  if (!test || std::holds_alternative<DropTest>(*test))
    return {{"--checkpoint", "is not available for a test of a few bodies", "leave it out"}};
  if (options.vtk_interval_s)
    return {{"--checkpoint", "does not go with --vtk: a run that goes on would lack the pictures of its beginning",
             "leave one of them out"}};
  return output_file_faults("--checkpoint", options.checkpoint, true);
}

/// What the run would take of time and, with pictures, of the disk beyond what anyone asks for by chance.
Faults effort_faults(const SimulateOptions& options, const Scene& scene) {
  double pictures = 0, grains = 1;
  if (const auto* test = std::get_if<Test>(&scene)) {
    grains = grains_needed(*test);
    const double steps = least_steps(*test, options.time_step_s);
    const std::string work = format("%.3g grains in %.3g steps", grains, steps);
    const double effort_s = least_effort_s(*test, options.time_step_s);
    if (auto faults =
            long_run_faults(options.file + ": grains", work, effort_s, options.threads, options.force, "larger grains");
        !faults.empty())
      return faults;
    if (options.vtk_interval_s) pictures = std::min(steps, moved_time_s(*test) / *options.vtk_interval_s);
  } else if (options.vtk_interval_s) {
    const auto& impact = std::get<Impact>(scene);
    grains = static_cast<double>(impact.grains.size());
    pictures = impact.duration_s / *options.vtk_interval_s;
  }
  return options.vtk_interval_s ? picture_faults(options.out, pictures, grains, options.force) : Faults{};
}

constexpr std::chrono::minutes kBetweenCheckpoints{2};

/// What a run leaves on the disk, now and then and when it is asked to stop, and goes on from.
class SavedRun {
 public:
  SavedRun(Checkpoint file, RunState found, const std::atomic<bool>& stop)
      : file_(std::move(file)), found_(std::move(found)), stop_(stop) {}

  std::shared_ptr<RunCheckpoint> checkpoint() {
    return std::make_shared<RunCheckpoint>([this] { return stop_ || Clock::now() > next_; },
                                           [this](const std::string& state) { keep(state); },
                                           std::exchange(found_.bytes, {}));
  }
  bool goes_on() const { return !found_.bytes.empty(); }
  const Faults& unwritten() const { return unwritten_; }
  /// All sessions together.
  double wall_s() const { return found_.wall_s + std::chrono::duration<double>(Clock::now() - start_).count(); }
  void remove() const { file_.remove(); }
  const Checkpoint& file() const { return file_; }

 private:
  using Clock = std::chrono::steady_clock;

  void keep(const std::string& state) {
    unwritten_ = file_.write({state, wall_s()});
    next_ = Clock::now() + kBetweenCheckpoints;
  }

  Checkpoint file_;
  RunState found_;
  const std::atomic<bool>& stop_;
  Clock::time_point start_ = Clock::now(), next_ = start_ + kBetweenCheckpoints;
  Faults unwritten_;
};

/// The outcome of a run, which may go on from a checkpoint. Errors: what that holds is no state of this run, though it
/// is what was written: it was made by hand.
Result<Outcome> outcome_of(const Scene& test, const RunOptions& run, const std::optional<SavedRun>& saved) {
  const auto simulate_it = [&] {
    return std::visit([&](const auto& of_apparatus) { return simulate(of_apparatus, run); }, test);
  };
  if (!saved) return simulate_it();
  try {
    Outcome outcome = simulate_it();
    if (run.checkpoint->is_told()) return outcome;
    return saved->file().no_state_of_this_run("it holds more than this run has");
  } catch (const BadState& bad) {
    return saved->file().no_state_of_this_run(bad.what());
  }
}

int simulate_file(const SimulateOptions& options) {
  auto found = read_scene(options.file, options.settings, options.test);
  if (!found.ok()) return report(found.faults());
  for (const std::string& remark : found.value().notes) note("pastefit: %s\n", remark.c_str());
  Scene test = std::move(found).value().scene;
  if (options.seed) {
    auto* of_lab = std::get_if<Test>(&test);
    if (!of_lab) return report({{"--seed", "an impact has no random packing", "leave it out"}});
    specimen_of(*of_lab).packing_seed = *options.seed;
  }
  const auto* of_lab = std::get_if<Test>(&test);
  if (of_lab)
    if (const auto faults = validate_memory(*of_lab, 1); !faults.empty()) return report(in_file(faults, options.file));
  if (of_lab) note("%s", apparatus_in_words(*of_lab).c_str());
  if (options.vtk_interval_s && options.out.empty())
    return report({{"--vtk", "has no folder to write to", "add --out DIR"}});
  if (const auto faults = effort_faults(options, test); !faults.empty()) return report(faults);
  if (const auto faults = checkpoint_faults(options, test); !faults.empty()) return report(faults);

  RunOptions run;
  run.steps.fixed_step_s = options.time_step_s;
  run.steps.threads = options.threads;
  const auto& stop = listen_for_stop();
  std::optional<SavedRun> saved;
  if (!options.checkpoint.empty()) {
    Checkpoint file(options.checkpoint, *of_lab, run);
    auto state = file.read();
    if (!state.ok()) return report(state.faults());
    saved.emplace(std::move(file), std::move(state).value(), stop);
    if (saved->goes_on())
      note("pastefit: goes on from %s, after %.0f s\n", options.checkpoint.c_str(), saved->wall_s());
    try {
      run.checkpoint = saved->checkpoint();
    } catch (const BadState& bad) {
      return report(saved->file().no_state_of_this_run(bad.what()));
    }
  }

  std::optional<OutputFolder> folder;
  std::optional<Pictures> pictures;
  if (!options.out.empty()) {
    const auto series = names_of_series(test);
    std::vector<std::string> results{kResult, kCurve};
    for (const std::string& name : series)
      for (const std::string_view layer : kLayers) results.push_back(name + std::string(layer) + ".pvd");
    auto opened = OutputFolder::open(options.out, results,
                                     options.force ? EarlierResult::replace : EarlierResult::refuse, kSpace);
    if (!opened.ok()) return report(opened.faults());
    folder = std::move(opened).value();
    if (options.vtk_interval_s) pictures.emplace(options.out, series);
  }

  Faults unwritten;
  std::map<std::string_view, Outline> outlines;
  run.watch_interval_s = options.vtk_interval_s.value_or(0.1);
  run.watch = [&](const Snapshot& snapshot) {
    if (!snapshot.world) return true;
    if (of_lab)
      if (auto seen = outline_at(*of_lab, snapshot)) outlines[seen->name] = std::move(seen->outline);
    if (pictures) unwritten = pictures->add(snapshot, series_in(test, snapshot));
    return unwritten.empty();
  };
  std::optional<SignOfLife> sign(std::in_place);
  run.pulse = [&](const Snapshot& snapshot) {
    sign->show(snapshot);
    return !stop && (!saved || saved->unwritten().empty());
  };
  const auto start = std::chrono::steady_clock::now();
  const auto ended = outcome_of(test, run, saved);
  sign.reset();
  if (!ended.ok()) return report(ended.faults());
  const Outcome& outcome = ended.value();
  const double wall_s =
      saved ? saved->wall_s() : std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!unwritten.empty()) return report(unwritten, kFailed);
  if (saved && !saved->unwritten().empty()) return report(saved->unwritten(), kFailed);
  if (saved && outcome.failure && outcome.failure->reason == FailureReason::stopped) {
    std::fprintf(stderr, "pastefit: stopped in %s at %.4g s; the same command goes on from %s\n",
                 outcome.failure->phase.c_str(), outcome.failure->time_s, options.checkpoint.c_str());
    return kFailed;
  }

  if (outcome.failure) outlines.clear();
  const auto text = json_text(simulation_json(outcome, outlines_json(outlines), wall_s));
  if (options.json)
    print("%s", text.c_str());
  else
    print_simulation(outcome, wall_s, of_lab && !std::holds_alternative<DropTest>(*of_lab));
  if (folder) {
    if (const auto faults = write_results(*folder, text, outcome); !faults.empty()) return report(faults, kFailed);
    note("wrote %s\n", folder->file(kResult).c_str());
    if (outcome.curve) note("wrote %s\n", folder->file(kCurve).c_str());
    if (pictures)
      for (const auto& file : pictures->indices()) note("wrote %s\n", file.c_str());
  }
  if (saved) saved->remove();
  if (of_lab)
    if (const auto remarks = remarks_on(*of_lab, {&outcome.observables, 1}); !remarks.empty())
      note("pastefit: %s\n", remarks.c_str());
  if (options.time_step_s) judge_step(*options.time_step_s, outcome.run.advised_step_s);
  if (!outcome.failure) return kDone;
  const auto& failure = *outcome.failure;
  std::fprintf(stderr, "pastefit: the simulation failed: %s in %s at %.4g s (step %lld): %s\n",
               std::string(name_of(failure.reason)).c_str(), failure.phase.c_str(), failure.time_s,
               static_cast<long long>(failure.step), failure.message.c_str());
  return kFailed;
}

}  // namespace

Command add_simulate(CLI::App& verb) {
  const auto options = std::make_shared<SimulateOptions>();
  verb.add_option("FILE", options->file, "study, card, laboratory, apparatus or impact file")->required();
  verb.add_option("--set", options->settings,
                  "PATH=VALUE, changes the file's content for this run, e.g. parameters.strength_pa=3000 or "
                  "grains.radius_mm=6; may be given again")
      ->type_name("PATH=VALUE")
      ->take_all();
  verb.add_option("--test", options->test, "which test of a study or card that has several; without it the first")
      ->type_name("NAME");
  verb.add_option("--seed", options->seed, "seed of the random packing")->check(whole_number());
  verb.add_option("--out", options->out,
                  "folder for " + kResult + ", " + kCurve + " of a test that draws one, and the ParaView series")
      ->type_name("DIR");
  verb.add_flag("--force", options->force,
                "replace an earlier result in DIR; compute for more than a day, or write more pictures than the disk "
                "has room for");
  verb.add_option("--checkpoint", options->checkpoint,
                  "file in which the run is kept every two minutes and when it is stopped; if it is there the run goes "
                  "on from it, with the same result bit for bit; it is removed when the run is over")
      ->type_name("FILE");
  verb.add_option("--time-step", options->time_step_s,
                  "fixed time step of the test; without it the step follows from the scene")
      ->type_name("SECONDS")
      ->check(number_from(1e-9, 0.01));
  add_threads(verb, options->threads,
              "threads that share the grains of the simulation (1); the result does not change");
  verb.add_flag("--json", options->json, "print the outcome as JSON");
  verb.add_option("--vtk", options->vtk_interval_s, "simulated time between two pictures of a ParaView series")
      ->type_name("SECONDS")
      ->check(positive_number());
  return [options] { return simulate_file(*options); };
}

}  // namespace pastefit
