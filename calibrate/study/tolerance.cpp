#include "calibrate/study/tolerance.h"

#include <algorithm>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/study/tests.h"

namespace pastefit {

bool is_length(std::string_view reading) {
  return reading.ends_with("_mm");
}

double tolerance_of(const Study& study, std::size_t test, std::size_t measurement) {
  const StudyTest& one = study.tests.at(test);
  const Measurement& read = one.lab.measurements.at(measurement);
  if (const auto& own = one.targets.at(measurement).tolerance) return *own;
  if (is_length(read.reading) && study.search.tolerance_mm) return *study.search.tolerance_mm;
  return default_tolerance(one.lab.test, read);
}

std::string ErrorUnit::words(double error, const char* pattern) const {
  return format(pattern, of(error)) + " " + name();
}

ErrorUnit error_unit_of(std::span<const std::pair<std::string_view, double>> fitted) {
  const bool in_mm = !fitted.empty() && std::ranges::all_of(fitted, [&](const auto& one) {
    return is_length(one.first) && one.second == fitted.front().second;
  });
  return in_mm ? ErrorUnit{fitted.front().second} : ErrorUnit{};
}

ErrorUnit error_unit_of(const Study& study) {
  const std::vector<StudyReading> readings = readings_of(study);
  std::vector<std::pair<std::string_view, double>> fitted;
  for (const StudyReading& reading : readings)
    if (reading.weight > 0) fitted.emplace_back(reading.measurement.reading, reading.tolerance);
  return error_unit_of(fitted);
}

}  // namespace pastefit
