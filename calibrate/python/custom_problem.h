#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/evaluate/reading_scoring.h"
#include "calibrate/python/asked_search.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"

namespace pastefit::python {

/// Calibration problem for tests unknown to pastefit: arbitrary parameters and readings, and search options.
struct CustomProblem {
  std::string title;
  std::vector<Parameter> parameters;   ///< all free
  std::vector<StudyReading> readings;  ///< with their tolerances
  SearchOptions search;
  std::string content;  ///< as JSON text
};

/// Reads {"title", "parameters": {NAME: {"free", "scale", "prior"}}, "measurements": {NAME: {"value",
/// "standard_deviation", "repeats"}}, "tolerances": {NAME: ...}, "weights": {NAME: ...}, "search"}, as in laboratory
/// and study files. Default tolerance: the standard deviation. Errors: every fault, with its place; names reserved by
/// candidates, answers or evaluations (`own`).
Result<CustomProblem> problem_from_json(const nlohmann::json& document, std::span<const std::string> own);

/// Answers to a problem, stored in `file`. Errors: those of `Store::open`; the store belongs to another problem.
Result<std::shared_ptr<AskedSearch>> search_of_problem(CustomProblem problem, const std::string& file,
                                                       const std::string& engine);

}  // namespace pastefit::python
