#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/evaluate/reading_scoring.h"
#include "calibrate/python/answers.h"
#include "calibrate/store/store.h"
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
/// Errors: every fault, each with its place; a name that candidates, answers or evaluations have themselves (`own`).
Result<CustomProblem> problem_from_json(const nlohmann::json& document, std::span<const std::string> own);

/// The answers to a problem, in the store of this file. Errors: those of `Store::open`; the file holds answers to
/// another problem.
Result<std::unique_ptr<Answers>> answers_to_problem(CustomProblem problem, const std::string& file,
                                                    const std::string& engine);

}  // namespace pastefit::python
