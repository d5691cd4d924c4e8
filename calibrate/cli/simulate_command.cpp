#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/card/scene.h"
#include "calibrate/card/standing.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/cli/understood.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/report/vtk.h"
#include "calibrate/store/checkpoint.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/store/output_folder.h"
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

Faults checkpoint_faults(const SimulateOptions& options, const Scene& scene) {
  if (options.checkpoint.empty()) return {};
  const auto* test = std::get_if<Test>(&scene);
  if (!test || std::holds_alternative<DropTest>(*test))
    return {{"--checkpoint", "is not available for a test of a few bodies", "leave it out"}};
  if (options.vtk_interval_s)
    return {{"--checkpoint", "cannot be combined with --vtk: a continued run would lack the first pictures",
             "leave one of them out"}};
  return output_file_faults("--checkpoint", options.checkpoint, true);
}

/// Faults of an excessive run time or, with pictures, disk usage.
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

/// Reads the scene, and prints notes on it to standard error.
Scene scene_of(const SimulateOptions& options) {
  auto [scene, notes] = value_or_throw(read_scene(options.file, options.settings, options.test));
  for (const std::string& remark : notes) note("pastefit: %s\n", remark.c_str());
  auto* test = std::get_if<Test>(&scene);
  if (options.seed && !test) refuse({{"--seed", "an impact has no random packing", "leave it out"}});
  if (!test) return scene;
  if (options.seed) specimen_of(*test).packing_seed = *options.seed;
  refuse(in_file(validate_memory(*test, 1), options.file));
  note(apparatus_in_words(*test));
  return scene;
}

/// Conflicts between options, or with the scene.
Faults option_faults(const SimulateOptions& options, const Scene& scene) {
  if (options.vtk_interval_s && options.out.empty())
    return {{"--vtk", "needs a folder for its files", "add --out DIR"}};
  if (auto faults = effort_faults(options, scene); !faults.empty()) return faults;
  return checkpoint_faults(options, scene);
}

nlohmann::ordered_json outlines_json(const std::map<std::string_view, Outline>& outlines) {
  auto out = nlohmann::ordered_json::object();
  for (const auto& [name, side] : outlines) {
    auto& points = out[std::string(name)] = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < side.height_m.size(); ++k)
      points.push_back({1e3 * (side.first_x_m + static_cast<double>(k) * side.spacing_m), 1e3 * side.height_m[k]});
  }
  return out;
}

/// Readings and run as JSON text, with the yield stresses from the readings (`test`: null for an impact). `outlines`:
/// by name, as the points of a profile in a laboratory file: {"step1": [[x_mm, z_mm], ...], ...}.
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

/// The same as text, without outlines. `packed`: the packing was random.
void print_simulation(const Outcome& outcome, double wall_s, bool packed) {
  for (const auto& [name, value] : outcome.readings.all()) print("%-26s %12.6g\n", name.c_str(), value);
  if (packed && !outcome.failure) print("One packing, error unknown: other packings (--seed) give other readings.\n");
  const auto& run = outcome.run;
  print("%lld grain%s, %lld steps of %.3g s, %.3g s simulated in %.3g s (%.3g million\nparticle-steps a second)%s\n",
        static_cast<long long>(run.particles), run.particles == 1 ? "" : "s", static_cast<long long>(run.steps),
        run.time_step_s, run.simulated_s, wall_s, static_cast<double>(run.particle_steps) / wall_s / 1e6,
        run.settled || outcome.failure ? "" : "; not quite at rest at the end of the simulated time");
}

/// One line per point below the axis names.
std::string csv_of(const Curve& curve) {
  std::string out = curve.x + "," + curve.y + "\n";
  for (const CurvePoint& point : curve.points) out += format("%.6g,%.6g\n", point.x, point.y);
  return out;
}

/// Prints whether the given step is stable.
void judge_step(double given_s, double advised_s) {
  const bool stable = given_s <= advised_s;
  note("pastefit: the time step %.3g s %s the advised %.3g s%s\n", given_s, stable ? "is within" : "exceeds", advised_s,
       stable ? "" : ": the result may be wrong; leave --time-step out, or give at most that");
}

/// Layers of a picture, one series each: suffixes of the name of the grains' series.
constexpr std::array kLayers{"", "-links", "-walls"};

/// One series each, for a clock of its own. A run has those of the stages that it comes to.
constexpr std::array kStages{"filling", "grains", "grains-second-drop"};

/// ParaView pictures of a run: grains, links and walls. A test has one series per stage, whose clock starts at the time
/// of its first snapshot; an impact has one stage.
class RunPictures {
 public:
  /// Writes nothing yet.
  explicit RunPictures(const std::string& folder) {
    for (const char* name : kStages) {
      Stage& stage = stages_.emplace_back();
      for (const char* layer : kLayers) stage.layers.emplace_back(folder, std::string(name) + layer);
    }
  }

  /// Index files of all series, or only of those that were written.
  std::vector<std::filesystem::path> indices(bool written) const {
    std::vector<std::filesystem::path> files;
    for (const Stage& stage : stages_)
      for (const VtkSeries& layer : stage.layers)
        if (stage.begun || !written) files.push_back(layer.index());
    return files;
  }

  /// Writes the pictures of a snapshot. Errors: a file cannot be written.
  Faults add(const Snapshot& snapshot) {
    const bool filling = snapshot.phase.starts_with("fill.");
    Stage& stage = stages_.at(filling ? 0 : static_cast<std::size_t>(snapshot.drop) + 1);
    // A stage may consist of several consecutive runs.
    if (snapshot.time_s < stage.last_s) stage.earlier_s += stage.last_s;
    stage.last_s = snapshot.time_s;
    stage.begun = true;
    const World& world = *snapshot.world;
    const std::array frames{grain_frame(world), link_frame(world), wall_frame(world)};
    for (std::size_t i = 0; i < frames.size(); ++i)
      if (auto faults = stage.layers[i].add(snapshot.time_s + stage.earlier_s, frames[i]); !faults.empty())
        return faults;
    return {};
  }

 private:
  struct Stage {
    std::vector<VtkSeries> layers;
    double last_s = 0, earlier_s = 0;
    bool begun = false;
  };

  std::vector<Stage> stages_;
};

/// One simulation with its observers and outputs.
class SingleSimulation {
 public:
  SingleSimulation(const SimulateOptions& options, const Scene& scene)
      : options_(options), scene_(scene), test_(std::get_if<Test>(&scene)) {
    run_.steps.fixed_step_s = options.time_step_s;
    run_.steps.threads = options.threads;
  }

  /// Returns the exit status. Refused if the saved state, or the result folder, is unusable.
  int run() {
    open_checkpoint();
    open_folder();
    run_.watch_interval_s = options_.vtk_interval_s.value_or(0.1);
    run_.watch = [this](const Snapshot& snapshot) { return watch(snapshot); };
    run_.pulse = [this, shown = shown_run(&stop_).pulse](const Snapshot& snapshot) {
      return shown(snapshot) && unsaved_.empty();
    };
    const Outcome outcome = simulated();
    run_.pulse = {};  // removes its line
    const double wall_s = wall_so_far_s();
    refuse(unwritten_, kFailed);
    refuse(unsaved_, kFailed);
    return close(outcome, wall_s);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::minutes kBetweenSaves{2};

  void open_checkpoint() {
    if (options_.checkpoint.empty()) return;
    checkpoint_.emplace(options_.checkpoint, *test_, run_);
    RunState found = value_or_throw(checkpoint_->read());
    wall_before_s_ = found.wall_s;
    if (!found.bytes.empty())
      note("pastefit: continues from %s, after %.0f s\n", options_.checkpoint.c_str(), wall_so_far_s());
    try {
      run_.checkpoint =
          std::make_shared<RunCheckpoint>([this] { return stop_ || Clock::now() > next_save_; },
                                          [this](const std::string& state) { save(state); }, std::move(found.bytes));
    } catch (const BadState& bad) {
      refuse(checkpoint_->no_state_of_this_run(bad.what()));
    }
  }

  void save(const std::string& state) {
    unsaved_ = checkpoint_->write({state, wall_so_far_s()});
    next_save_ = Clock::now() + kBetweenSaves;
  }

  /// Sum over all sessions.
  double wall_so_far_s() const { return wall_before_s_ + std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// Refused if the checkpoint has a valid checksum, but no state of this run: the file was made by hand.
  Outcome simulated() const {
    if (!checkpoint_) return simulate(scene_, run_);
    std::string why = "it holds more than this run has";
    try {
      Outcome outcome = simulate(scene_, run_);
      if (run_.checkpoint->is_told()) return outcome;
    } catch (const BadState& bad) {
      why = bad.what();
    }
    throw Refusal{checkpoint_->no_state_of_this_run(why), kBadInput};
  }

  void open_folder() {
    if (options_.out.empty()) return;
    std::vector<std::string> results{kResult, kCurve};
    for (const auto& file : RunPictures(options_.out).indices(false)) results.push_back(file.filename());
    folder_ = value_or_throw(OutputFolder::open(
        options_.out, results, options_.force ? EarlierResult::replace : EarlierResult::refuse, kSpace));
    if (options_.vtk_interval_s) pictures_.emplace(options_.out);
  }

  bool watch(const Snapshot& snapshot) {
    if (!snapshot.world) return true;
    if (test_)
      if (auto seen = outline_at(*test_, snapshot)) outlines_[seen->name] = std::move(seen->outline);
    if (pictures_) unwritten_ = pictures_->add(snapshot);
    return unwritten_.empty();
  }

  /// Prints and writes the results.
  int close(const Outcome& outcome, double wall_s) {
    if (checkpoint_ && outcome.failure && outcome.failure->reason == FailureReason::stopped) {
      std::fprintf(stderr, "pastefit: stopped in %s at %.4g s; the same command continues from %s\n",
                   outcome.failure->phase.c_str(), outcome.failure->time_s, options_.checkpoint.c_str());
      return kFailed;
    }
    if (outcome.failure) outlines_.clear();
    const auto text = simulation_json(outcome, test_, outlines_, wall_s);
    if (options_.json)
      print(text);
    else
      print_simulation(outcome, wall_s, test_ && !std::holds_alternative<DropTest>(*test_));
    if (folder_) write(outcome, text);
    if (checkpoint_) checkpoint_->remove();
    if (test_)
      if (const auto remarks = remarks_on(*test_, {&outcome.readings, 1}); !remarks.empty())
        note("pastefit: %s\n", remarks.c_str());
    if (options_.time_step_s) judge_step(*options_.time_step_s, outcome.run.advised_step_s);
    if (!outcome.failure) return kDone;
    const Failure& failure = *outcome.failure;
    std::fprintf(stderr, "pastefit: the simulation failed: %s in %s at %.4g s (step %lld): %s\n",
                 std::string(name_of(failure.reason)).c_str(), failure.phase.c_str(), failure.time_s,
                 static_cast<long long>(failure.step), failure.message.c_str());
    return kFailed;
  }

  /// Writes readings and, if there is one, the curve; pictures are already written.
  void write(const Outcome& outcome, const std::string& text) const {
    folder_->clear({kCurve});
    refuse(write_atomically(folder_->file(kResult), text), kFailed);
    if (outcome.curve) refuse(write_atomically(folder_->file(kCurve), csv_of(*outcome.curve)), kFailed);
    note("wrote %s\n", folder_->file(kResult).c_str());
    if (outcome.curve) note("wrote %s\n", folder_->file(kCurve).c_str());
    if (pictures_)
      for (const auto& file : pictures_->indices(true)) note("wrote %s\n", file.c_str());
  }

  const SimulateOptions& options_;
  const Scene& scene_;
  const Test* test_;  ///< null for an impact
  const std::atomic<bool>& stop_ = listen_for_stop();
  RunOptions run_;
  std::optional<Checkpoint> checkpoint_;
  double wall_before_s_ = 0;  ///< of earlier sessions
  Clock::time_point start_ = Clock::now(), next_save_ = start_ + kBetweenSaves;
  std::optional<OutputFolder> folder_;
  std::optional<RunPictures> pictures_;
  std::map<std::string_view, Outline> outlines_;
  Faults unwritten_, unsaved_;  ///< faults of pictures and of the checkpoint
};

int simulate_file(const SimulateOptions& options) {
  const Scene scene = scene_of(options);
  refuse(option_faults(options, scene));
  return SingleSimulation(options, scene).run();
}

}  // namespace

Command add_simulate(CLI::App& verb) {
  const auto options = std::make_shared<SimulateOptions>();
  verb.add_option("FILE", options->file, "study, card, laboratory, apparatus or impact file")->required();
  verb.add_option("--set", options->settings,
                  "PATH=VALUE, changes the file's content for this run, e.g. parameters.strength_pa=3000 or "
                  "grains.radius_mm=6; repeatable")
      ->type_name("PATH=VALUE")
      ->take_all();
  verb.add_option("--test", options->test, "test of a study or card with several; default: the first")
      ->type_name("NAME");
  verb.add_option("--seed", options->seed, "seed of the random packing")->check(whole_number());
  verb.add_option("--out", options->out,
                  "folder for " + kResult + ", " + kCurve + " of a test that has a curve, and the ParaView series")
      ->type_name("DIR");
  verb.add_flag(
      "--force", options->force,
      "replace an earlier result in DIR; start a run of more than a day, or a series larger than the free disk space");
  verb.add_option("--checkpoint", options->checkpoint,
                  "file that saves the run every two minutes and when it is stopped; if it exists, the run continues "
                  "from it, bit for bit; removed at the end of the run")
      ->type_name("FILE");
  verb.add_option("--time-step", options->time_step_s, "fixed time step; default: the program chooses it")
      ->type_name("SECONDS")
      ->check(number_from(1e-9, 0.01));
  add_threads(verb, options->threads, "threads of the simulation (1); the result does not depend on it");
  verb.add_flag("--json", options->json, "print the outcome as JSON");
  verb.add_option("--vtk", options->vtk_interval_s, "simulated time between two pictures of a ParaView series")
      ->type_name("SECONDS")
      ->check(positive_number());
  return [options] { return simulate_file(*options); };
}

}  // namespace pastefit
