#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"

namespace pastefit::python {

/// What a person who interrupts sets; a run looks at it now and then. Python holds it as `_core.Stop`.
struct Stop {
  std::atomic<bool> asked = false;
};

/// The document of a text that Python's json wrote.
nlohmann::json parsed(const std::string& text);

/// {"title", "parameters", "readings", "budget_simulations"}: what a study or a problem fits, and to what.
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

}  // namespace pastefit::python
