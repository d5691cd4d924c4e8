#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/search/calibration.h"
#include "calibrate/store/store.h"

namespace pastefit::python {

/// {"status", "reason", "simulated", "known", "failures", "card", "summary", "intervals", "correlation"}
nlohmann::ordered_json result_json(const CalibrationResult& result);

/// One object for each evaluation, in the order of arrival: number, test's packing, parameters and readings by name.
nlohmann::ordered_json evaluations_json(const Store& store);

/// Where a search is, for who asks from another thread.
nlohmann::ordered_json progress_json(const Progress& progress, const std::string& phase);

}  // namespace pastefit::python
