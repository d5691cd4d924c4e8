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

/// Slow-downs of our engine by more than 10 % against the last line of the same machine, scene and steps in the file
/// `csv`, one sentence each. Empty if there is no such file.
std::vector<std::string> slow_downs(const std::filesystem::path& csv, const std::vector<SceneResult>& results);

/// Adds a line for each engine and scene to the file, which is made if it is not there. The file is replaced whole.
Faults append_csv(const std::filesystem::path& csv, const std::vector<SceneResult>& results);

}  // namespace pastefit
