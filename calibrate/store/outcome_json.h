#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

#include "calibrate/laboratory/sketch.h"
#include "core/step/run.h"

namespace pastefit {

/// The JSON form of what a simulation was asked and answers, as the store keeps it and `simulate --json` prints it.
/// Doubles survive the round trip through text bit for bit; the non-finite ones, for which JSON has no number, are
/// the strings "nan", "inf" and "-inf".
nlohmann::ordered_json number_to_json(double value);
double number_from_json(const nlohmann::json& in);

/// The parameters that do not have their default value, {"friction": 0.15, ...}, and all of them from it. Shape: one
/// value for each of `parameter_kinds()`.
nlohmann::json parameters_to_json(std::span<const double> values);
std::vector<double> parameters_from_json(const nlohmann::json& in);

/// {"step1.height_mm": 101.5, ...}, in the order in which the readings were taken.
nlohmann::ordered_json to_json(const Readings& readings);
/// {"reason", "phase", "step", "time_s", "grain", "value", "limit", "message"}, or null.
nlohmann::ordered_json to_json(const std::optional<Failure>& failure);
/// {"particles", "steps", "particle_steps", "time_step_s", "simulated_s", "wall_s", "settled", "ended_early",
/// "energy_error"}.
nlohmann::ordered_json to_json(const RunSummary& run, double wall_s);

/// {"heap", "points": [[x, y], ...]}
nlohmann::ordered_json to_json(const Sketch& sketch);

/// The inverses. Errors: throw nlohmann::json::exception or std::invalid_argument when the text is not what the
/// functions above write; a caller that reads a file turns them into a fault.
Readings readings_from_json(const nlohmann::ordered_json& in);
std::int64_t whole_number_from_json(const nlohmann::json& in);
std::optional<Failure> failure_from_json(const nlohmann::json& in);
RunSummary run_from_json(const nlohmann::json& in);
Sketch sketch_from_json(const nlohmann::json& in);

}  // namespace pastefit
