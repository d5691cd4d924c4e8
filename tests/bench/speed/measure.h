#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// How to measure.
struct MeasureOptions {
  bool peers = false;
  int repeats = 3;              ///< of every engine, in turn; the median counts
  double patience_s = 60;       ///< an engine whose run took longer is not run again
  int steps = 0;                ///< timed steps instead of the scene's own; 0: its own
  bool energy_balance = false;  ///< our engine keeps its energy balance; no peer keeps one
  std::string kernels{};        ///< instruction set of our engine's kernels where steps are timed; empty: the widest
};

/// One engine's runs of a scene.
struct TimedEngine {
  std::string name;                                   ///< as in `Peer`, or "ours", or "ours with energy balance"
  std::string laws;                                   ///< peers only
  std::vector<double> seconds;                        ///< of the processor, each run
  double peak_bytes = 0;                              ///< largest resident set of the process
  double time_step_s = 0;                             ///< it was run at; 0: it chose its own
  std::string problem;                                ///< why there is no result
  std::vector<std::pair<std::string, double>> notes;  ///< what else it told, by JSON key

  bool measured() const { return problem.empty() && !seconds.empty(); }
  double median() const;
};

/// A scene, ours first, then the peers.
struct SceneResult {
  std::string scene;
  double grains = 0;
  double steps = 0;  ///< timed; 0 where the time to an answer counts
  std::vector<TimedEngine> engines;
  std::vector<std::string> not_installed;  ///< Debian packages

  const TimedEngine& ours() const { return engines.front(); }
  /// How many times as fast as the fastest peer we are; empty if no peer was measured.
  std::optional<double> ratio_to_fastest_peer() const;
  double particle_steps_per_s(const TimedEngine& engine) const { return grains * steps / engine.median(); }
};

/// The scenes that can be measured: those of `scene_names()`, "test", "calibration" and "calibration-NN" for each
/// shipped mix.
std::vector<std::string> measurable_scenes();

/// Why a scene cannot be measured on this machine (it does not exist, or has not the memory); empty: it can.
Faults validate_scene(const std::string& scene);

/// Measures a scene: ours and every peer in turn, each run in a process of its own. Grains and
/// files of the peers live in a temporary folder until the program ends. Requirement: `validate_scene` is empty.
/// Errors: an engine's in its `problem`; throws std::runtime_error if the scene itself cannot be made.
SceneResult measure(const std::string& scene, const MeasureOptions& options);

}  // namespace pastefit
