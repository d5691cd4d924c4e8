#include "calibrate/python/custom_problem.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "calibrate/base/json_reader.h"
#include "calibrate/search/strategies.h"
#include "calibrate/study/free_parameter.h"
#include "calibrate/study/search_options.h"

namespace pastefit::python {

namespace {

constexpr double kLargest = 1e12;

std::vector<Parameter> read_parameters(ObjectReader& document) {
  std::vector<Parameter> parameters;
  document.object(
      "parameters", Need::required,
      [&](ObjectReader& reader) {
        for (const std::string& name : reader.keys()) {
          Parameter& parameter = parameters.emplace_back();
          parameter.name = name;
          parameter.stated = true;
          reader.object(name, Need::required, [&](ObjectReader& one) {
            read_free(one, {-kLargest, kLargest}, parameter);
          });
        }
        if (parameters.empty())
          document.fault("parameters", "none is named", "{\"friction\": {\"free\": [0.05, 0.8]}}");
      },
      "{\"friction\": {\"free\": [0.05, 0.8]}}");
  return parameters;
}

StudyReading read_measurement(ObjectReader& reader, const std::string& name) {
  StudyReading reading;
  reading.name = reading.measurement.reading = name;
  reader.number("value", reading.measurement.value, {-kLargest, kLargest}, Need::required);
  reader.number("standard_deviation", reading.measurement.standard_deviation, {1 / kLargest, kLargest}, Need::required);
  reader.integer("repeats", reading.measurement.repeats, 1, 1'000'000, Need::optional);
  reading.tolerance = reading.measurement.standard_deviation;
  return reading;
}

std::vector<StudyReading> read_readings(ObjectReader& document) {
  std::vector<StudyReading> readings;
  const std::string example = "{\"angle_deg\": {\"value\": 32, \"standard_deviation\": 1}}";
  document.object(
      "measurements", Need::required,
      [&](ObjectReader& reader) {
        for (const std::string& name : reader.keys())
          reader.object(name, Need::required,
                        [&](ObjectReader& one) { readings.push_back(read_measurement(one, name)); });
        if (readings.empty()) document.fault("measurements", "there is none", example);
      },
      example);
  document.object("tolerances", Need::optional, [&](ObjectReader& reader) {
    for (StudyReading& one : readings) reader.number(one.name, one.tolerance, {1 / kLargest, kLargest}, Need::optional);
  });
  document.object("weights", Need::optional, [&](ObjectReader& reader) {
    for (StudyReading& one : readings) reader.number(one.name, one.weight, {0, 1e6}, Need::optional);
  });
  return readings;
}

/// In a candidate and its answer all of these stand side by side, under their names.
Faults clashing_names(const CustomProblem& problem) {
  constexpr std::array<std::string_view, 4> own{"_id", "seed", "error", "traceback"};
  Faults faults;
  const auto check = [&](const std::string& place, const std::string& name) {
    if (std::ranges::count(own, name) > 0)
      faults.push_back({place + "." + name, "is a key of every candidate or answer", "another name"});
  };
  for (const Parameter& parameter : problem.parameters) check("parameters", parameter.name);
  for (const StudyReading& reading : problem.readings) {
    check("measurements", reading.name);
    if (std::ranges::count(problem.parameters, reading.name, &Parameter::name) > 0)
      faults.push_back({"measurements." + reading.name, "is the name of a parameter, too", "another name"});
  }
  return faults;
}

}  // namespace

Result<CustomProblem> problem_from_json(const nlohmann::json& document) {
  Faults faults;
  CustomProblem problem;
  problem.content = document.dump();
  if (!document.is_object()) return Fault{"", "is no object", "{\"title\", \"parameters\", \"measurements\", ...}"};
  {
    ObjectReader reader(document, "", faults);
    reader.text("title", problem.title, Need::required);
    problem.parameters = read_parameters(reader);
    problem.readings = read_readings(reader);
    read_search_options(reader, 1, problem.search);
  }
  for (Fault& fault : clashing_names(problem)) faults.push_back(std::move(fault));
  if (faults.empty()) faults = validate(problem.search, static_cast<int>(problem.parameters.size()));
  if (!faults.empty()) return faults;
  return problem;
}

}  // namespace pastefit::python
