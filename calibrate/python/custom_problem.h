#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"

namespace pastefit::python {

/// What a study is for tests that pastefit does not know: parameters and readings of any name, and how to search.
struct CustomProblem {
  std::string title;
  std::vector<Parameter> parameters;   ///< all free
  std::vector<StudyReading> readings;  ///< with their tolerances
  SearchOptions search;
  std::string content;  ///< as JSON text
};

/// Reads {"title", "parameters": {NAME: {"free", "scale", "prior"}}, "measurements": {NAME: {"value",
/// "standard_deviation", "repeats"}}, "tolerances": {NAME: ...}, "weights": {NAME: ...}, "search"}, with the meaning
/// that these have in laboratory and study files. A reading without a tolerance has its standard deviation as one.
/// Errors: every fault, each with its place.
Result<CustomProblem> problem_from_json(const nlohmann::json& document);

}  // namespace pastefit::python
