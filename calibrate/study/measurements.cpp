#include "calibrate/study/measurements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace pastefit {
namespace {

using enum ReadingKind;

constexpr std::array<ReadingKey, 18> keys{{
    {"fill.mass_kg", "fill.mass_kg", mass},
    {"step1.height_mm", "step1.height_mm", height},
    {"step1.slump_mm", "step1.height_mm", slump},
    {"step1.height_max_mm", "step1.height_max_mm", height},
    {"step1.height_axis_mm", "step1.height_axis_mm", height, false, false},
    {"step1.lateral_shift_mm", "step1.lateral_shift_mm", shift, false, false},
    {"step1.spread_mm", "step1.spread_mm", spread},
    {"step1.spread_orthogonal_mm", "step1.spread_orthogonal_mm", spread, false, false},
    {"step1.profile", "step1.profile_mm", profile, false, false},
    {"step2.height_mm", "step2.height_mm", height, true},
    {"step2.slump_mm", "step2.height_mm", slump, true},
    {"step2.height_max_mm", "step2.height_max_mm", height, true},
    {"step2.height_axis_mm", "step2.height_axis_mm", height, true, false},
    {"step2.spread_mm", "step2.spread_mm", spread, true},
    {"step2.spread_orthogonal_mm", "step2.spread_orthogonal_mm", spread, true, false},
    {"step2.profile", "step2.profile_mm", profile, true, false},
    {"step2.plateau_sag_mm", "step2.plateau_sag_mm", plateau_sag, true},
    {"step2.plateau_width_mm", "step2.plateau_width_mm", plateau_width, true},
}};

/// The values the reading can have, in the unit of its key, with some room for the tolerances of an apparatus.
Range range_of(ReadingKind kind, const SlumpTable& test) {
  constexpr double room = 0.02;
  const double mould_mm = 1000 * test.mould.height_m;
  const double base_mm = 2000 * test.mould.base_radius_m;
  const double table_mm = 1000 * test.table_length_m;
  const double filling_kg = test.bulk_density_kg_m3 * volume_m3(test.mould);
  switch (kind) {
    case height:
      return {0, (1 + room) * mould_mm};
    case slump:
      return {-room * mould_mm, mould_mm};
    case spread:
      return {(1 - room) * base_mm, std::max(table_mm, base_mm)};
    case shift:
    case profile:
      return {0, table_mm};
    case plateau_sag:
      return {-mould_mm, mould_mm};
    case plateau_width:
      return {0, table_mm};
    case mass:
      return {0.5 * filling_kg, 1.5 * filling_kg};
  }
  return {};
}

std::string advice_on_deviation(ReadingKind kind) {
  const std::string advice = "give the standard deviation of one reading, or at least 2 repeats that differ";
  if (kind != height && kind != slump) return advice + "; no repeatability of this reading is published";
  return advice + "; published for the slump: 21 mm as the 95 % limit between two results (ASTM C143-98), so about 7.5";
}

void average(const std::vector<double>& repeats, Measurement& measurement) {
  const auto count = static_cast<double>(repeats.size());
  measurement.repeats = static_cast<int>(repeats.size());
  measurement.value = std::accumulate(repeats.begin(), repeats.end(), 0.0) / count;
  double squares = 0;
  for (const double repeat : repeats) squares += (repeat - measurement.value) * (repeat - measurement.value);
  measurement.standard_deviation = std::sqrt(squares / (count - 1));
}

void read_one(ObjectReader& reader, const ReadingKey& key, const Range& range, Measurement& measurement) {
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
                 advice_on_deviation(key.kind));
}

/// A heap seen from the side; its reading is the difference from it.
void read_profile(ObjectReader& reader, SlumpTable& test, bool second_step, Measurement& measurement) {
  const double half_table_mm = 500 * test.table_length_m;
  std::vector<OutlinePoint> points;
  constexpr std::size_t kFewest = 5;
  if (reader.pairs("points", points, {-half_table_mm, half_table_mm}, range_of(height, test), Need::required, kFewest))
    for (auto& [x, z] : points) {
      x *= 1e-3;
      z *= 1e-3;
    }
  (second_step ? test.reading.outline_step2 : test.reading.outline_step1) = std::move(points);
  reader.number("standard_deviation", measurement.standard_deviation, {0, 10000, true}, Need::required);
}

/// Readings of one heap, or of one before and after the drop, whose order no heap turns round.
struct Order {
  std::string_view smaller, larger;
  const char* why;
};
constexpr std::array<Order, 7> orders{{
    {"step1.height_mm", "step1.height_max_mm", "the highest point of a heap is not below its height"},
    {"step2.height_mm", "step2.height_max_mm", "the highest point of a heap is not below its height"},
    {"step1.height_axis_mm", "step1.height_max_mm", "the highest point of a heap is not below its height"},
    {"step2.height_axis_mm", "step2.height_max_mm", "the highest point of a heap is not below its height"},
    {"step2.height_mm", "step1.height_mm", "a drop does not raise a heap"},
    {"step2.height_max_mm", "step1.height_max_mm", "a drop does not raise a heap"},
    {"step1.spread_mm", "step2.spread_mm", "a drop does not draw a heap together"},
}};

void check_orders(ObjectReader& document, const std::vector<Measurement>& measurements) {
  constexpr double sure = 3;  // standard deviations of the difference of two means
  const auto error = [](const Measurement& one) { return one.standard_deviation / std::sqrt(one.repeats); };
  for (const Order& order : orders) {
    const auto smaller = std::ranges::find(measurements, order.smaller, &Measurement::observable);
    const auto larger = std::ranges::find(measurements, order.larger, &Measurement::observable);
    if (smaller == measurements.end() || larger == measurements.end()) continue;
    if (smaller->value - larger->value <= sure * std::hypot(error(*smaller), error(*larger))) continue;
    document.fault("measurements",
                   std::string(order.smaller) + " (" + shown(smaller->value) + ") contradicts " +
                       std::string(order.larger) + " (" + shown(larger->value) + "): " + order.why,
                   "look for swapped readings, or give standard deviations that allow for the difference");
  }
}

}  // namespace

std::span<const ReadingKey> reading_keys() {
  return keys;
}

std::vector<Measurement> read_measurements(ObjectReader& document, SlumpTable& test) {
  std::vector<Measurement> measurements;
  document.object("measurements", Need::required, [&](ObjectReader& reader) {
    bool any = false;
    for (const ReadingKey& key : keys) {
      any = any || reader.has(key.key);
      if (key.second_step && !test.drop) {
        reader.refuse(key.key, "the apparatus has no drop plate, so there is no step 2",
                      "leave it out, or describe the plate in apparatus.drop_plate");
        continue;
      }
      Measurement measurement;
      measurement.observable = key.observable;
      const auto read = [&](ObjectReader& one) {
        if (key.kind == profile)
          read_profile(one, test, key.second_step, measurement);
        else
          read_one(one, key, range_of(key.kind, test), measurement);
      };
      if (!reader.object(key.key, Need::optional, read)) continue;
      if (!measurements.empty() && measurements.back().observable == key.observable)
        reader.fault(key.key, "slump and height of one heap are one reading", "give one of them");
      if (key.kind == slump) measurement.value = 1000 * test.mould.height_m - measurement.value;
      measurements.push_back(std::move(measurement));
    }
    check_orders(document, measurements);
    if (!any) document.fault("measurements", "holds no reading", "give at least one, e.g. \"step1.height_mm\"");
  });
  return measurements;
}

}  // namespace pastefit
