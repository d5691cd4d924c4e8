#include "calibrate/study/tolerance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
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
  return std::visit([&](const auto& kind) { return default_tolerance(kind, read); }, one.lab.test);
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

namespace {

constexpr double kDeviations = 3;

std::string grains_in_words(const Test& test) {
  return "about " + plain(grains_needed(test), 2) + " grains of " +
         format("%g mm", mm * specimen_of(test).grains.radius_m) + " mean radius";
}

}  // namespace

std::string note_on_grain_count(const Test& test) {
  const double count = grains_needed(test);
  const bool is_bed = why_of_that_size(test).empty();  // one body needs no minimum number of grains
  if (!is_bed || count >= kFewGrains) return {};
  const double radius_mm = mm * specimen_of(test).grains.radius_m * std::cbrt(count / kFewGrains);
  return grains_in_words(test) + format(
                                     " fill the apparatus, fewer than %g: heaps of so few grains vary much, and a "
                                     "wrong material may fit the readings; use a mean radius of %.2g mm or less",
                                     kFewGrains, radius_mm);
}

std::vector<std::string> notes_on_tolerances(const Study& study) {
  std::vector<std::string> notes;
  for (const StudyReading& reading : readings_of(study)) {
    const Test& test = study.tests[reading.test].lab.test;
    const auto own_kinds = reading_kinds(test);
    const ReadingKind* kind = find_kind(own_kinds, reading.measurement.reading);
    // The tolerance of a shift comes from the standards' rejection of sheared-off heaps.
    if (reading.weight == 0 || !kind || kind->key.find("lateral_shift") != kind->key.npos) continue;
    const double published = kind->published_deviation;
    const double measured = reading.measurement.standard_deviation;
    const double deviation = published > 0 ? std::min(published, measured) : measured;
    if (reading.tolerance <= kDeviations * deviation) continue;
    notes.push_back(
        reading.name + " counts as met within " + plain(reading.tolerance) +
        format(", which is %.1f standard deviations (%s) of the ", reading.tolerance / deviation,
               plain(deviation, 2).c_str()) +
        (deviation < measured ? "published repeatability" : "laboratory") + ", with " + grains_in_words(test) +
        ": a wrong material may fit; give a smaller tolerance, or smaller grains if their radius sets the tolerance");
  }
  return notes;
}

}  // namespace pastefit
