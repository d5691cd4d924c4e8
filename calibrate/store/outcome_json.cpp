#include "calibrate/store/outcome_json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "calibrate/study/parameters.h"

namespace pastefit {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json number_to_json(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

double number_from_json(const json& in) {
  if (in.is_number()) return in.get<double>();
  const auto text = in.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  throw std::invalid_argument("'" + text + "' is not a number");
}

json parameters_to_json(std::span<const double> values) {
  const auto kinds = parameter_kinds();
  json out = json::object();
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (values[i] != kinds[i].default_value) out[std::string(kinds[i].name)] = values[i];
  return out;
}

std::vector<double> parameters_from_json(const json& in) {
  std::vector<double> values = default_values();
  const auto kinds = parameter_kinds();
  for (const auto& [name, value] : in.items()) {
    const auto kind = std::ranges::find(kinds, name, &ParameterKind::name);
    if (kind == kinds.end()) throw std::invalid_argument("'" + name + "' is not a parameter");
    values[static_cast<std::size_t>(kind - kinds.begin())] = value.get<double>();
  }
  return values;
}

ordered_json to_json(const Readings& readings) {
  auto out = ordered_json::object();
  for (const auto& [name, value] : readings.all()) out[name] = number_to_json(value);
  return out;
}

ordered_json to_json(const std::optional<Failure>& failure) {
  if (!failure) return nullptr;
  return {{"reason", name_of(failure->reason)},
          {"phase", failure->phase},
          {"step", failure->step},
          {"time_s", number_to_json(failure->time_s)},
          {"grain", failure->grain},
          {"value", number_to_json(failure->value)},
          {"limit", number_to_json(failure->limit)},
          {"message", failure->message}};
}

ordered_json to_json(const RunSummary& run, double wall_s) {
  return {{"particles", run.particles},
          {"steps", run.steps},
          {"particle_steps", run.particle_steps},
          {"time_step_s", number_to_json(run.time_step_s)},
          {"simulated_s", number_to_json(run.simulated_s)},
          {"wall_s", number_to_json(wall_s)},
          {"settled", run.settled},
          {"ended_early", run.ended_early},
          {"energy_error", run.energy_error ? number_to_json(*run.energy_error) : ordered_json()}};
}

ordered_json to_json(const Sketch& sketch) {
  return {{"heap", sketch.heap}, {"points", sketch.points}};
}

Readings readings_from_json(const ordered_json& in) {
  Readings out;
  for (const auto& [name, value] : in.items()) out.set(name, number_from_json(value));
  return out;
}

std::int64_t whole_number_from_json(const json& in) {
  if (!in.is_number_integer()) throw std::invalid_argument(in.dump() + " is not a whole number");
  return in.get<std::int64_t>();
}

std::optional<Failure> failure_from_json(const json& in) {
  if (in.is_null()) return std::nullopt;
  Failure out;
  const auto reason = in.at("reason").get<std::string>();
  int index = 0;
  while (name_of(static_cast<FailureReason>(index)) != reason) {
    if (static_cast<FailureReason>(index) == FailureReason::stopped)
      throw std::invalid_argument("'" + reason + "' is not a known reason of a failure");
    ++index;
  }
  out.reason = static_cast<FailureReason>(index);
  out.phase = in.at("phase").get<std::string>();
  out.step = whole_number_from_json(in.at("step"));
  out.time_s = number_from_json(in.at("time_s"));
  out.grain = whole_number_from_json(in.at("grain"));
  out.value = number_from_json(in.at("value"));
  out.limit = number_from_json(in.at("limit"));
  out.message = in.at("message").get<std::string>();
  return out;
}

RunSummary run_from_json(const json& in) {
  RunSummary out;
  out.particles = whole_number_from_json(in.at("particles"));
  out.steps = whole_number_from_json(in.at("steps"));
  out.particle_steps = whole_number_from_json(in.at("particle_steps"));
  out.time_step_s = number_from_json(in.at("time_step_s"));
  out.simulated_s = number_from_json(in.at("simulated_s"));
  out.settled = in.at("settled").get<bool>();
  out.ended_early = in.at("ended_early").get<bool>();
  if (const auto& error = in.at("energy_error"); !error.is_null()) out.energy_error = number_from_json(error);
  return out;
}

Sketch sketch_from_json(const json& in) {
  return {in.at("heap").get<bool>(), in.at("points").get<std::vector<std::array<double, 2>>>()};
}

}  // namespace pastefit
