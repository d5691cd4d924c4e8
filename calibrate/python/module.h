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

/// What a person who interrupts sets; a run looks at it now and then. Python holds it as `_core.Stop`.
struct Stop {
  std::atomic<bool> asked = false;
};

/// The document of a text that Python's json wrote.
nlohmann::json parsed(const std::string& text);

/// {"title", "parameters", "readings", "budget_simulations", "screening"}: what a study or a problem fits, and to what.
nlohmann::ordered_json description_json(const std::string& title, const std::vector<Parameter>& parameters,
                                        const std::vector<StudyReading>& readings, const SearchOptions& search);

// Each adds the classes and functions of one file.
void add_stop(pybind11::module_& module);
void add_study(pybind11::module_& module);
void add_simulation(pybind11::module_& module);
void add_tasks(pybind11::module_& module);
void add_calibration(pybind11::module_& module);
void add_search(pybind11::module_& module);
void add_cards(pybind11::module_& module);

/// The engine whose simulations run wherever `ask` takes them: `ask(task, goes_on)` gets what `simulate_task` is to be
/// called with, and gives what it gave; nothing, if `goes_on()` became false and nobody waits any more.
/// `name`: of this engine among those that run at the same time.
Engine engine_of(pybind11::function ask, std::string name);

/// {"status", "reason", "simulated", "known", "failures", "card", "summary", "intervals", "correlation"}
nlohmann::ordered_json result_json(const CalibrationResult& result);

/// One object for each evaluation, in the order of arrival: number, test's packing, parameters and readings by name.
nlohmann::ordered_json evaluations_json(const Store& store);
nlohmann::ordered_json evaluation_json(std::size_t number, const StoredEvaluation& one,
                                       nlohmann::ordered_json parameters);

/// Where a search is, for who asks from another thread.
nlohmann::ordered_json progress_json(const Progress& progress, const std::string& phase);

}  // namespace pastefit::python
