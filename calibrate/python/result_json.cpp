#include <nlohmann/json.hpp>

#include "calibrate/inference/description.h"
#include "calibrate/python/module.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/study/parameters.h"

namespace pastefit::python {

using nlohmann::ordered_json;

namespace {

ordered_json interval_json(const ParameterInterval& interval) {
  return {{"parameter", interval.parameter.name},
          {"recommended", interval.recommended},
          {"lower", interval.lower.at},
          {"upper", interval.upper.at},
          {"lower_known", interval.lower.known},
          {"upper_known", interval.upper.known},
          {"bound_lower", interval.parameter.lower},
          {"bound_upper", interval.parameter.upper},
          {"uncertainty", interval.uncertainty}};
}

}  // namespace

ordered_json result_json(const CalibrationResult& result) {
  ordered_json out{{"status", name_of(result.search.status)},
                   {"reason", result.search.reason},
                   {"simulated", result.counts.simulated},
                   {"known", result.counts.answered},
                   {"failures", ordered_json::object()},
                   {"card", nullptr},
                   {"summary", ""},
                   {"intervals", ordered_json::array()},
                   {"correlation", ordered_json::array()}};
  for (const auto& [reason, count] : result.counts.failures) out["failures"][std::string(name_of(reason))] = count;
  if (result.card) {
    out["card"] = to_json(*result.card);
    out["summary"] = summary_of(*result.card, result.inference ? describe(*result.inference) : "");
  }
  if (!result.inference) return out;
  for (const ParameterInterval& interval : result.inference->intervals)
    out["intervals"].push_back(interval_json(interval));
  out["correlation"] = result.inference->correlation;
  return out;
}

ordered_json evaluation_json(std::size_t number, const StoredEvaluation& one, ordered_json parameters) {
  return {{"number", number},
          {"packing", one.packing},
          {"parameters", std::move(parameters)},
          {"readings", to_json(one.readings)},
          {"failure", one.failure ? std::string(name_of(one.failure->reason)) : ""},
          {"message", one.failure ? one.failure->message : ""},
          {"ended_early", one.run.ended_early}};
}

ordered_json evaluations_json(const Store& store) {
  ordered_json out = ordered_json::array();
  for (const StoredEvaluation& one : store.all()) {
    ordered_json parameters = ordered_json::object();
    for (std::size_t i = 0; i < one.values.size(); ++i)
      parameters[std::string(parameter_kinds()[i].name)] = one.values[i];
    out.push_back(evaluation_json(out.size(), one, std::move(parameters)));
    out.back()["wall_s"] = one.wall_s;
  }
  return out;
}

ordered_json progress_json(const Progress& progress) {
  return {{"phase", progress.phase},
          {"simulations", progress.simulations},
          {"budget", progress.budget},
          {"best_miss", progress.best_error < 0 ? ordered_json() : ordered_json(progress.best_error)},
          {"note", progress.note}};
}

}  // namespace pastefit::python
