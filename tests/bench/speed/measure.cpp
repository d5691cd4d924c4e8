#include "tests/bench/speed/measure.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "calibrate/base/machine.h"
#include "core/step/kernels.h"
#include "tests/bench/speed/calibration.h"
#include "tests/bench/speed/ours.h"
#include "tests/bench/speed/peer_files.h"
#include "tests/bench/speed/two_step.h"

namespace pastefit {

namespace {

using Json = nlohmann::json;

constexpr unsigned kLimit = 1800;  // [s] for one run of one engine
constexpr unsigned kCalibrationLimit = 4 * 3600;
constexpr std::string_view kCoarseFirst = "-coarse-first";  // ending of a scene of calibration
constexpr double kBytesPerGrain = 4000;                     // enough for LAMMPS, LIGGGHTS and us
constexpr double kBytesPerGrainOfYade = 20'000;

class ScratchFolder {
 public:
  ScratchFolder() : path_(std::filesystem::temp_directory_path() / ("pastefit-bench-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// An engine and how it is run once.
struct Contender {
  TimedEngine result;
  std::function<void(TimedEngine&)> run;
};

/// The end of what a failed run said, on one line.
std::string last_lines(std::string text) {
  const std::size_t longest = 300;
  if (text.size() > longest) text = "..." + text.substr(text.size() - longest);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Runs a function that returns {"seconds": ..., notes} as JSON in a child.
void run_ours_in_child(TimedEngine& engine, const std::function<Json()>& function, unsigned limit_s = kLimit) {
  const ChildResult child = run_function([&] { return function().dump(); }, limit_s);
  if (!child.ok) {
    engine.problem = last_lines(child.output);
    return;
  }
  Json said = Json::parse(child.output);
  engine.seconds.push_back(said.at("seconds").get<double>());
  said.erase("seconds");
  engine.notes.clear();
  for (const auto& [name, value] : said.items()) engine.notes.push_back({name, value.get<double>()});
  engine.peak_bytes = std::max(engine.peak_bytes, static_cast<double>(child.peak_bytes));
}

/// Every contender once, then every one again: what disturbs the machine meets all alike.
void run_in_turn(std::vector<Contender>& contenders, const MeasureOptions& options) {
  for (int round = 0; round < options.repeats; ++round)
    for (Contender& c : contenders) {
      const bool slow = !c.result.seconds.empty() && c.result.seconds.front() > options.patience_s;
      if (slow || !c.result.problem.empty()) continue;
      c.run(c.result);
    }
}

SceneResult gathered(std::string scene, double grains, double steps, std::vector<Contender>& contenders,
                     std::vector<std::string> not_installed) {
  SceneResult result{std::move(scene), grains, steps, {}, std::move(not_installed)};
  for (Contender& c : contenders) result.engines.push_back(std::move(c.result));
  return result;
}

/// The peers that are installed, and the packages of those that are not.
std::pair<std::vector<Peer>, std::vector<std::string>> installed(const std::vector<Peer>& all) {
  std::pair<std::vector<Peer>, std::vector<std::string>> found;
  for (const Peer& peer : all) {
    if (is_installed(peer.program))
      found.first.push_back(peer);
    else if (std::find(found.second.begin(), found.second.end(), peer.package) == found.second.end())
      found.second.push_back(peer.package);
  }
  return found;
}

void run_peer(TimedEngine& engine, const Peer& peer, const std::vector<std::string>& command, bool whole) {
  const ChildResult child = run_program(command, kLimit);
  const std::optional<double> seconds = whole && child.ok ? child.processor_s : loop_seconds(peer, child);
  if (!seconds) {
    engine.problem = child.ok ? "it does not say how long its loop took" : last_lines(child.output);
    return;
  }
  engine.seconds.push_back(*seconds);
  engine.peak_bytes = std::max(engine.peak_bytes, static_cast<double>(child.peak_bytes));
  if (!whole) return;
  engine.notes.clear();
  for (const char* height : {"step1.height_mm", "step2.height_mm"})
    if (const auto value = number_after(child.output, std::string(height) + " "))
      engine.notes.push_back({std::string(height).replace(5, 1, "_"), *value});
}

Contender contender_of(const Peer& peer, std::string_view deck, const Variables& variables, double time_step) {
  Contender contender;
  contender.result.name = peer.name;
  contender.result.laws = peer.laws;
  contender.result.time_step_s = time_step;
  contender.run = [peer, command = command_of(peer, deck, variables), whole = deck == "test"](TimedEngine& engine) {
    run_peer(engine, peer, command, whole);
  };
  return contender;
}

/// Does something in a child, so that the parent stays small: the children it forks later begin with its memory.
void prepare(const std::function<void()>& work) {
  const ChildResult child = run_function(
      [&] {
        work();
        return std::string();
      },
      kLimit);
  if (!child.ok) throw std::runtime_error("the scene cannot be made: " + last_lines(child.output));
}

/// Makes a bed unless it is there already: scenes in the same mould share it.
BedSize make_bed(const std::filesystem::path& file, const std::function<Bed()>& fill) {
  if (!std::filesystem::exists(file)) prepare([&] { write_bed(file, fill()); });
  return read_bed_size(file);
}

Variables step_variables(const Scene& scene, const BedSize& size, const ScratchFolder& folder) {
  const Mould mould = scene_mould();
  return {{"grains", (folder / "grains.data").string()},
          {"mould", (folder / "mould.stl").string()},
          {"step", decimal(kSceneStep)},
          {"gravity", decimal(kGravity)},
          {"density", decimal(kGrainDensity)},
          {"warm_steps", std::to_string(scene.warm_steps)},
          {"steps", std::to_string(scene.steps)},
          {"base_radius", decimal(mould.base_radius_m)},
          {"top_radius", decimal(mould.top_radius_m)},
          {"height", decimal(mould.height_m)},
          {"lift_speed", decimal(kLiftSpeed)},
          {"length", decimal(size.length_m)},
          {"width", decimal(size.width_m)}};
}

Space space_of(const Scene& scene, const Bed& bed) {
  if (scene.container == Container::box)
    return {{0, 0, -kSceneRadius}, {bed.length_m, bed.width_m, bed.top_m + 10 * kSceneRadius}};
  // LIGGGHTS wants the whole of its mould inside, also when it is lifted.
  const double lifted = kLiftSpeed * kSceneStep * (scene.warm_steps + scene.steps);
  return {{-0.5, -0.5, -kSceneRadius}, {0.5, 0.5, scene_mould().height_m + lifted + 0.02}};
}

const KernelTable& kernels_called(const std::string& instruction_set) {
  for (const KernelTable* table : kernels_this_processor_runs())
    if (table->instruction_set == instruction_set) return *table;
  return kernels_of_this_processor();
}

SceneResult measure_steps(Scene scene, const MeasureOptions& options, const ScratchFolder& folder) {
  if (options.steps > 0) scene.steps = options.steps;
  const bool box = scene.container == Container::box;
  const std::filesystem::path bed_file = folder / (box ? scene.name : "mould");
  const BedSize size = make_bed(bed_file, [&] { return fill(scene); });

  std::vector<Contender> contenders(1);
  contenders[0].result.name = options.energy_balance ? "ours with energy balance" : "ours";
  if (!options.kernels.empty()) contenders[0].result.name += ", " + options.kernels;
  contenders[0].result.time_step_s = kSceneStep;
  contenders[0].run = [&](TimedEngine& engine) {
    run_ours_in_child(engine, [&]() -> Json {
      const OurRun run = run_ours(scene, read_bed(bed_file), options.energy_balance, kernels_called(options.kernels));
      Json said{{"seconds", run.seconds},
                {"advised_step_s", run.advised_step_s},
                {"contacts_per_grain", run.contacts},
                {"bridges_per_grain", run.bridges}};
      const double grain_steps = static_cast<double>(scene.steps) * run.grains;
      for (int stage = 0; stage < StageClock::stages; ++stage)
        said[std::string(StageClock::names[stage]) + "_ns"] = 1e9 * run.stages.seconds[stage] / grain_steps;
      return said;
    });
  };
  std::vector<std::string> missing;
  if (options.peers) {
    prepare([&] {
      const Bed bed = read_bed(bed_file);
      write_grains(folder / "grains.data", bed.centres, kSceneRadius, kGrainDensity, space_of(scene, bed));
      write_mould(folder / "mould.stl", scene_mould());
    });
    const double skin = (box ? 0.125 : 0.5) * kSceneRadius;
    auto found = installed(peers_of(scene_material(scene.cohesive), kSceneRadius, skin));
    missing = std::move(found.second);
    const Variables variables = step_variables(scene, size, folder);
    for (const Peer& peer : found.first) {
      contenders.push_back(contender_of(peer, box ? "box" : "slump", variables, kSceneStep));
      const double needed = kBytesPerGrainOfYade * size.grains;
      if (peer.engine == Peer::TimedEngine::yade && needed > 0.6 * memory_available_bytes())
        contenders.back().result.problem = "not run: it would need " + decimal(1e-9 * needed) + " GB of memory";
    }
  }
  run_in_turn(contenders, options);
  return gathered(scene.name, size.grains, scene.steps, contenders, std::move(missing));
}

/// The mix of a scene of calibration: "calibration" is that of mix 20, "calibration-66" that of mix 66.
std::optional<std::string> mix_of(std::string_view scene) {
  if (scene.ends_with(kCoarseFirst)) scene.remove_suffix(kCoarseFirst.size());
  if (scene == "calibration") return "20";
  for (const std::string& mix : mixes())
    if (scene == "calibration-" + mix) return mix;
  return {};
}

SceneResult measure_test(const MeasureOptions& options, const ScratchFolder& folder) {
  const std::filesystem::path bed_file = folder / "test";
  const BedSize size = make_bed(bed_file, fill_two_step);
  const Bed bed = read_bed(bed_file);

  std::vector<Contender> contenders(1);
  contenders[0].result.name = "ours";
  contenders[0].run = [&](TimedEngine& engine) {
    run_ours_in_child(engine, [&]() -> Json {
      const TestAnswer answer = answer_ours(bed);
      return {{"seconds", answer.seconds},
              {"step1_height_mm", answer.step1_height_mm},
              {"step2_height_mm", answer.step2_height_mm}};
    });
  };
  std::vector<std::string> missing;
  if (options.peers) {
    const SlumpTest test = two_step_test();
    auto found = installed(peers_of(test.contact, test.grains.radius_m, 0.25 * test.grains.radius_m));
    missing = std::move(found.second);
    const Variables variables = test_variables(bed, folder.path());
    for (const Peer& peer : found.first)
      contenders.push_back(contender_of(peer, "test", variables, peer_test_step(bed)));
  }
  run_in_turn(contenders, options);
  return gathered("test", size.grains, 0, contenders, std::move(missing));
}

Json json_of(const CalibrationCost& cost) {
  return {{"seconds", cost.core_s},
          {"wall_s", cost.wall_s},
          {"simulations", cost.simulations},
          {"coarse_simulations", cost.coarse_simulations},
          {"seconds_a_simulation", cost.simulation_s},
          {"confirmed", cost.status == CalibrationStatus::confirmed ? 1 : 0},
          {"confirmed_mm", cost.confirmed_mm},
          {"smallest_advised_step_s", cost.smallest_advised_s},
          {"median_advised_step_s", cost.median_advised_s},
          {"share_below_target", cost.share_below_target},
          {"share_far_below_target", cost.share_far_below_target}};
}

/// A calibration by the program's search, and by a plain one; with coarse grains first by ours alone. Every turn has a
/// search seed of its own.
SceneResult measure_calibration(const std::string& scene, const MeasureOptions& options, const ScratchFolder& folder) {
  const std::string mix = mix_of(scene).value();
  const bool coarse_first = scene.ends_with(kCoarseFirst);
  std::vector<Contender> contenders(coarse_first ? 1 : 2);
  contenders[0].result.name = "ours";
  if (!coarse_first) contenders[1].result.name = "plain search";
  double smallest_step = 0;
  for (Contender& contender : contenders) {
    const bool ours = &contender == &contenders[0];
    contender.run = [&, ours](TimedEngine& engine) {
      const std::uint64_t seed = engine.seconds.size() + 1;
      const auto store = folder / (scene + (ours ? "-ours-" : "-plain-") + std::to_string(seed));
      run_ours_in_child(
          engine,
          [&] {
            return json_of(ours ? calibrate_ours(mix, seed, coarse_first, store)
                                : calibrate_plainly(mix, seed, store, smallest_step));
          },
          kCalibrationLimit);
      if (ours)
        for (const auto& [name, value] : engine.notes)
          if (name == "smallest_advised_step_s") smallest_step = value;
      if (!ours) engine.time_step_s = smallest_step;
    };
  }
  run_in_turn(contenders, options);
  return gathered(scene, 0, 0, contenders, {});
}

}  // namespace

double TimedEngine::median() const {
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  return n % 2 == 1 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]);
}

std::optional<double> SceneResult::ratio_to_fastest_peer() const {
  std::optional<double> best;
  for (std::size_t k = 1; k < engines.size(); ++k)
    if (engines[k].measured() && (!best || engines[k].median() < *best)) best = engines[k].median();
  if (!best || !ours().measured()) return {};
  return *best / ours().median();
}

std::vector<std::string> measurable_scenes() {
  std::vector<std::string> names;
  for (const std::string_view name : scene_names()) names.emplace_back(name);
  names.insert(names.end(), {"test", "calibration"});
  for (const std::string& mix : mixes()) names.push_back("calibration-" + mix);
  for (const std::string& mix : mixes()) names.push_back("calibration-" + mix + std::string(kCoarseFirst));
  return names;
}

Faults validate_scene(const std::string& name) {
  const std::vector<std::string> all = measurable_scenes();
  if (std::find(all.begin(), all.end(), name) == all.end()) {
    std::string known;
    for (const std::string& one : all) known += (known.empty() ? "" : ", ") + one;
    return {{name, "is not a scene of this benchmark", "take one of " + known}};
  }
  if (name == "test" || mix_of(name)) return {};
  const Scene scene = scene_named(name);
  const double needed = kBytesPerGrain * kTileGrains * scene.tiles_x * scene.tiles_y;
  const double free = memory_available_bytes();
  if (needed <= free) return {};
  return {{name, "needs up to " + decimal(needed / 1e9) + " GB, " + decimal(free / 1e9) + " GB are free",
           "close other programs or take a smaller box"}};
}

SceneResult measure(const std::string& scene, const MeasureOptions& options) {
  static const ScratchFolder folder;
  if (scene == "test") return measure_test(options, folder);
  if (mix_of(scene)) return measure_calibration(scene, options, folder);
  return measure_steps(scene_named(scene), options, folder);
}

}  // namespace pastefit
