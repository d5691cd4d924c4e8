#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/result.h"
#include "tests/bench/speed/measure.h"

namespace pastefit {

/// The machine as results are compared by: processor and number of cores.
std::string machine_name();

/// A scene as a table for a person, with what is not installed and how to install it.
std::string table_of(const SceneResult& result);

/// Cost of a particle step in boxes of growing size, against the smallest: the table of `--scaling`.
std::string scaling_table(const std::vector<SceneResult>& boxes);

/// {"format": "pastefit-bench-1", "machine": ..., "scenes": {NAME: {"ours": {...}, "peers": {NAME: {...}},
/// "ratio_to_fastest_peer": ...}}}. An engine has "particle_steps_per_s" where steps are timed, "seconds" (median of
/// "seconds_of_runs"), "peak_bytes_per_grain", "time_step_s" and what it told; or "problem".
nlohmann::ordered_json json_of(const std::vector<SceneResult>& results);

/// Our engine's processor time against what is on record for a scene and number of steps.
struct Comparison {
  std::string scene, machine;  ///< the one the record is of
  bool same_machine = false;
  double now_s = 0, then_s = 0;
};

/// Each scene against the last line of this machine in the file `csv`, or of another where there is none. Scenes that
/// are not on record are left out; without such a file all are.
std::vector<Comparison> compared_with(const std::filesystem::path& csv, const std::vector<SceneResult>& results);
std::string sentence_of(const Comparison& comparison);
/// By more than 10 %, on the same machine.
bool is_slow_down(const Comparison& comparison);

/// Adds a line for each engine and scene to the file, which is made if it is not there. The file is replaced whole.
Faults append_csv(const std::filesystem::path& csv, const std::vector<SceneResult>& results);

}  // namespace pastefit
