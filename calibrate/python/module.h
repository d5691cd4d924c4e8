#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calibrate/base/refusal.h"
#include "calibrate/calibrate.h"
#include "calibrate/laboratory/engine.h"
#include "calibrate/search/calibration.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"
#include "core/result.h"

namespace pastefit::python {

/// Stop flag set on interruption and polled by runs; `_core.Stop` in Python.
struct Stop {
  std::atomic<bool> asked = false;
};

/// Description of a study or problem: {"title", "parameters", "readings", "budget_simulations", "screening"}.
nlohmann::ordered_json description_json(const std::string& title, const std::vector<Parameter>& parameters,
                                        const std::vector<StudyReading>& readings, const SearchOptions& search);

// Each adds the classes and functions of one file.
void add_simulation(pybind11::module_& module);
void add_tasks(pybind11::module_& module);
void add_calibration(pybind11::module_& module);
void add_search(pybind11::module_& module);
void add_cards(pybind11::module_& module);

/// Engine that simulates through `ask(task, goes_on)`, which receives the argument of `simulate_task` and returns its
/// result; nothing if `goes_on()` became false. `name`: unique among engines running at the same time.
Engine engine_of(pybind11::function ask, std::string name);

/// {"status", "reason", "simulated", "known", "failures", "card", "summary", "intervals", "correlation"}
nlohmann::ordered_json result_json(const CalibrationResult& result);

/// One object per evaluation, in order of arrival: number, test's packing, parameters and readings by name.
nlohmann::ordered_json evaluations_json(const Store& store);
nlohmann::ordered_json evaluation_json(std::size_t number, const StoredEvaluation& one,
                                       nlohmann::ordered_json parameters);

/// Progress of a search, for calls from another thread.
nlohmann::ordered_json progress_json(const Progress& progress);

}  // namespace pastefit::python
