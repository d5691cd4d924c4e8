#include "calibrate/study/measurements.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/rigs/slump/slump_readings.h"

namespace pastefit {
namespace {

Range range_of(const ReadingKind& kind, const SlumpTable& test) {
  const auto [smallest, largest] = kind.possible(test);
  return {smallest, largest};
}

std::string advice_on_deviation(const ReadingKind& kind) {
  const std::string advice = "give the standard deviation of one reading, or at least 2 repeats that differ";
  return advice + "; " +
         (kind.repeatability.empty() ? "no repeatability of this reading is published"
                                     : std::string(kind.repeatability));
}

void average(const std::vector<double>& repeats, Measurement& measurement) {
  const auto count = static_cast<double>(repeats.size());
  measurement.repeats = static_cast<int>(repeats.size());
  measurement.value = std::accumulate(repeats.begin(), repeats.end(), 0.0) / count;
  double squares = 0;
  for (const double repeat : repeats) squares += (repeat - measurement.value) * (repeat - measurement.value);
  measurement.standard_deviation = std::sqrt(squares / (count - 1));
}

void read_one(ObjectReader& reader, const ReadingKind& kind, const SlumpTable& test, Measurement& measurement) {
  const Range range = range_of(kind, test);
  std::vector<double> repeats;
  if (reader.numbers("repeats", repeats, range, Need::optional, 2)) average(repeats, measurement);
  if (reader.has("repeats"))
    reader.refuse("value", "stands beside \"repeats\"", "leave it out: the mean of the repeats is taken");
  else
    reader.number("value", measurement.value, range, Need::required);

  double least = 0;
  const bool stated = reader.number("standard_deviation", least, {0, 10000, true}, Need::optional);
  measurement.standard_deviation = std::max(measurement.standard_deviation, least);
  const bool tried = reader.has("standard_deviation") || (reader.has("repeats") && repeats.empty());
  if (!stated && !tried && measurement.standard_deviation == 0)
    reader.fault("standard_deviation", repeats.empty() ? "is missing" : "is missing, and the repeats are all the same",
                 advice_on_deviation(kind));
}

/// A heap seen from the side; its reading is the difference from it.
void read_profile(ObjectReader& reader, const ReadingKind& kind, SlumpTable& test, Measurement& measurement) {
  const double half_table_mm = 500 * test.table_length_m;
  const Range heights = range_of(*reading_kind("step1.height_mm"), test);
  std::vector<OutlinePoint> points;
  constexpr std::size_t kFewest = 5;
  if (reader.pairs("points", points, {-half_table_mm, half_table_mm}, heights, Need::required, kFewest))
    for (auto& [x, z] : points) {
      x *= 1e-3;
      z *= 1e-3;
    }
  (kind.stage == Stage::step2 ? test.reading.outline_step2 : test.reading.outline_step1) = std::move(points);
  reader.number("standard_deviation", measurement.standard_deviation, {0, 10000, true}, Need::required);
}

/// Readings of one heap, or of one before and after the drop, have an order that no heap turns round.
void check_orders(ObjectReader& document, const std::vector<Measurement>& measurements) {
  constexpr double sure = 3;  // standard deviations of the difference of two means
  const auto error = [](const Measurement& one) { return one.standard_deviation / std::sqrt(one.repeats); };
  for (const Measurement& smaller : measurements) {
    for (const Ceiling& ceiling : reading_kind(smaller.observable)->ceilings) {
      const auto larger = std::ranges::find(measurements, ceiling.name, &Measurement::observable);
      if (larger == measurements.end()) continue;
      if (smaller.value - larger->value <= sure * std::hypot(error(smaller), error(*larger))) continue;
      document.fault("measurements",
                     smaller.observable + " (" + shown(smaller.value) + ") contradicts " + larger->observable + " (" +
                         shown(larger->value) + "): " + std::string(ceiling.why),
                     "look for swapped readings, or give standard deviations that allow for the difference");
    }
  }
}

}  // namespace

std::vector<Measurement> read_measurements(ObjectReader& document, SlumpTable& test) {
  std::vector<Measurement> measurements;
  document.object("measurements", Need::required, [&](ObjectReader& reader) {
    bool any = false;
    for (const ReadingKind& kind : reading_kinds()) {
      if (kind.key.empty()) continue;
      any = any || reader.has(kind.key);
      if (kind.stage == Stage::step2 && !test.drop) {
        reader.refuse(kind.key, "the apparatus has no drop plate, so there is no step 2",
                      "leave it out, or describe the plate in apparatus.drop_plate");
        continue;
      }
      Measurement measurement;
      measurement.observable = kind.measure;
      const auto read = [&](ObjectReader& one) {
        if (kind.with_outline)
          read_profile(one, kind, test, measurement);
        else
          read_one(one, kind, test, measurement);
      };
      if (!reader.object(kind.key, Need::optional, read)) continue;
      if (!measurements.empty() && measurements.back().observable == kind.measure)
        reader.fault(kind.key, "slump and height of one heap are one reading", "give one of them");
      if (kind.measure != kind.name) measurement.value = 1000 * test.mould.height_m - measurement.value;
      measurements.push_back(std::move(measurement));
    }
    check_orders(document, measurements);
    if (!any) document.fault("measurements", "holds no reading", "give at least one, e.g. \"step1.height_mm\"");
  });
  return measurements;
}

}  // namespace pastefit
