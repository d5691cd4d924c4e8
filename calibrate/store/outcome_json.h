#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

#include "calibrate/laboratory/sketch.h"
#include "core/step/run.h"

namespace pastefit {

/// JSON form of the input and the outcome of a simulation, for the store and `simulate --json`. Doubles survive the
/// round trip bit for bit; non-finite ones, which JSON lacks, are the strings "nan", "inf" and "-inf".
nlohmann::ordered_json number_to_json(double value);
double number_from_json(const nlohmann::json& in);

/// Parameters that differ from their default, {"friction": 0.15, ...}; and all parameters from it. Shape: one value for
/// each of `parameter_kinds()`.
nlohmann::json parameters_to_json(std::span<const double> values);
std::vector<double> parameters_from_json(const nlohmann::json& in);

/// {"step1.height_mm": 101.5, ...}, in the order of the readings.
nlohmann::ordered_json to_json(const Readings& readings);
/// {"reason", "phase", "step", "time_s", "grain", "value", "limit", "message"}, or null.
nlohmann::ordered_json to_json(const std::optional<Failure>& failure);
/// {"particles", "steps", "particle_steps", "time_step_s", "simulated_s", "wall_s", "settled", "ended_early",
/// "energy_error"}.
nlohmann::ordered_json to_json(const RunSummary& run, double wall_s);

/// {"heap", "points": [[x, y], ...]}
nlohmann::ordered_json to_json(const Sketch& sketch);

/// Inverse functions. Errors: throw nlohmann::json::exception or std::invalid_argument for text that the functions
/// above do not write; callers that read files turn them into faults.
Readings readings_from_json(const nlohmann::ordered_json& in);
std::int64_t whole_number_from_json(const nlohmann::json& in);
std::optional<Failure> failure_from_json(const nlohmann::json& in);
RunSummary run_from_json(const nlohmann::json& in);
Sketch sketch_from_json(const nlohmann::json& in);

}  // namespace pastefit
