#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/measurement.h"
#include "calibrate/study/lab.h"
#include "calibrate/study/schemas.h"

namespace pastefit {

Questions::Questions(ObjectReader& document) : faults_(document.faults()) {
  document.texts("confirmed", confirmed_, Need::optional);
}

void Questions::ask(const std::string& place, std::string what, std::string remedy) {
  if (std::ranges::count(confirmed_, place) > 0)
    note(place, std::move(what) + ", as confirmed");
  else
    faults_.push_back({place, std::move(what),
                       std::move(remedy) + "; if it is right, say \"confirmed\": [" + in_quotes(place) + "]"});
}

namespace {

/// Standard deviations of a reading, in its unit. Smaller ones are slips and would give the reading an unbounded
/// weight.
constexpr Range deviations{1e-6, 10000};

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

/// Critical range of n repeats over their standard deviation, exceeded in 5 of 100 cases (factor f(n) of ISO 5725-6);
/// nearly constant above n = 20.
double critical_range(std::size_t repeats) {
  static constexpr std::array<double, 19> factors{2.8, 3.3, 3.6, 3.9, 4.0, 4.2, 4.3, 4.4, 4.5, 4.6,
                                                  4.6, 4.7, 4.7, 4.8, 4.8, 4.9, 4.9, 5.0, 5.0};
  return factors[std::min(repeats - 2, factors.size() - 1)];
}

/// Repeat with the largest distance from the median.
double farthest_of(std::vector<double> repeats) {
  std::ranges::sort(repeats);
  const double middle = (repeats[(repeats.size() - 1) / 2] + repeats[repeats.size() / 2]) / 2;
  return std::abs(repeats.front() - middle) > std::abs(repeats.back() - middle) ? repeats.front() : repeats.back();
}

/// Asks about repeats whose range is at least twice the critical range.
void judge_scatter(const std::string& place, const ReadingKind& kind, const std::vector<double>& repeats,
                   Questions& questions) {
  if (kind.published_deviation == 0) return;
  const auto [least, most] = std::ranges::minmax(repeats);
  const double explained = critical_range(repeats.size()) * kind.published_deviation;
  if (most - least <= explained) return;
  const auto unit = unit_of_key(kind.key);
  const std::string end = unit ? " " + std::string(unit->name) : "";
  std::string what = "has repeats that differ by " + shown(most - least) + end +
                     "; the test's repeatability explains " + format("%.0f", explained) + end + " of " +
                     std::to_string(repeats.size()) + " repeats (" + std::string(kind.repeatability) + ")";
  if (repeats.size() > 2) what += "; " + shown(farthest_of(repeats)) + end + " is an outlier";
  if (most - least <= 2 * explained)
    questions.note(place, std::move(what));
  else
    questions.ask(place, std::move(what), "leave out what was misread, and look for decimal commas and other units");
}

void read_one(ObjectReader& reader, const ReadingKind& kind, Measurement& measurement, Questions& questions) {
  const Range range{kind.possible.smallest, kind.possible.largest};
  const std::size_t before = reader.faults().size();
  std::vector<double> repeats;
  if (reader.numbers("repeats", repeats, range, Need::optional, 2)) {
    average(repeats, measurement);
    judge_scatter(reader.place(), kind, repeats, questions);
  }
  if (reader.has("repeats"))
    reader.refuse("value", "stands beside \"repeats\"", "leave it out: the mean of the repeats is taken");
  else
    reader.number("value", measurement.value, range, Need::required);
  if (!kind.bounded_by.empty())
    for (std::size_t k = before; k < reader.faults().size(); ++k)
      reader.faults()[k].remedy += "; its largest value is " + std::string(kind.bounded_by);

  double least = 0;
  const bool stated = reader.number("standard_deviation", least, deviations, Need::optional);
  measurement.standard_deviation = std::max(measurement.standard_deviation, least);
  const bool tried = reader.has("standard_deviation") || (reader.has("repeats") && repeats.empty());
  if (!stated && !tried && measurement.standard_deviation < deviations.smallest)
    reader.fault("standard_deviation", repeats.empty() ? "is missing" : "is missing, and the repeats are all the same",
                 advice_on_deviation(kind));
}

std::string cut_short(std::string text) {
  constexpr std::size_t longest = 60;
  if (text.size() > longest) text.replace(longest, std::string::npos, "...");
  return text;
}

/// Correct form of a reading that is given as a bare number or list.
std::string form_of(const ReadingKind& kind, const nlohmann::json* content) {
  const std::string deviation = kind.published_deviation > 0 ? format("%.2g", kind.published_deviation) : "5";
  if (content && content->is_number())
    return "write {\"value\": " + text_of(*content) + ", \"standard_deviation\": " + deviation + "}";
  if (content && content->is_array() && !kind.from_outline)
    return "write {\"repeats\": " + cut_short(content->dump()) + "}";
  if (kind.name == "step1.spread_curve_mm") return R"({"points": [[s, mm], ...], "standard_deviation": 10})";
  return kind.from_outline ? R"({"points": [[x_mm, z_mm], ...], "standard_deviation": 6})"
                           : R"({"value": ..., "standard_deviation": ...}, or {"repeats": [...]})";
}

/// Checks the order of readings of one heap, e.g. before and after the drop. Variation between heaps affects both
/// readings alike, so one standard deviation is a wide margin.
void check_orders(ObjectReader& document, std::span<const ReadingKind> kinds,
                  const std::vector<Measurement>& measurements) {
  constexpr double sure = 1;  // standard deviations of the difference of two means
  const auto error = [](const Measurement& one) { return one.standard_deviation / std::sqrt(one.repeats); };
  for (const Measurement& smaller : measurements) {
    for (const Ceiling& ceiling : find_kind(kinds, smaller.reading)->ceilings) {
      const auto larger = std::ranges::find(measurements, ceiling.name, &Measurement::reading);
      if (larger == measurements.end()) continue;
      if (smaller.value - larger->value <= sure * std::hypot(error(smaller), error(*larger))) continue;
      document.fault("measurements",
                     smaller.reading + " (" + shown(smaller.value) + ") contradicts " + larger->reading + " (" +
                         shown(larger->value) + "): " + std::string(ceiling.why),
                     "look for swapped readings: " + smaller.reading + " " + shown(larger->value) + " and " +
                         larger->reading + " " + shown(smaller.value) +
                         "; or give standard deviations that allow for the difference");
    }
  }
}

/// Reports all readings of other kinds of tests as one fault; true if there are any.
bool refuse_strange(ObjectReader& reader, const Test& test, std::span<const ReadingKind> own) {
  std::string strange;
  std::string_view other;
  for (const std::string_view word : kinds_of_tests()) {
    for (const ReadingKind& kind : reading_kinds(*test_of_kind(word))) {
      if (kind.key.empty() || !reader.has(kind.key) || std::ranges::count(own, kind.key, &ReadingKind::key) > 0)
        continue;
      reader.known(kind.key);
      strange += (strange.empty() ? "" : ", ") + std::string(kind.key);
      other = word;
    }
  }
  if (strange.empty()) return false;
  const std::string told(kind_of(test)), meant(other);
  reader.faults().push_back({"measurements",
                             "a " + told + " test has no " + strange + ": readings of a " + meant + " test",
                             "readings of a " + told + " test, or \"test\": " + in_quotes(meant) + " in this file"});
  return true;
}

/// Refuses times given for readings that have none, with those readings.
bool refuse_times(ObjectReader& reader, std::span<const ReadingKind> own) {
  bool any = false;
  for (const std::string& key : reader.keys()) {
    const std::optional<Unit> unit = unit_of_key(key);
    const bool time = (unit && unit->key == "s") || key.find("t500") != std::string::npos || key.ends_with("t50");
    if (!time || std::ranges::count(own, key, &ReadingKind::key) > 0) continue;
    reader.refuse(key, "is a time that is not read",
                  "a flow has step1.t500_s, the time to a spread of apparatus.reading.flow.diameter_mm, and "
                  "step1.flow_time_s; leave out others");
    any = true;
  }
  return any;
}

constexpr ReadingKind yield_stress_kind{
    .name = "yield_stress_pa", .key = "yield_stress_pa", .measure = "yield_stress_pa", .possible = {1e-2, 1e5}};

/// Predicted readings of a fluid with this yield stress, as members of "measurements"; empty without a formula.
std::string predicted_in_words(const Test& test, double yield_stress_pa) {
  std::string out;
  for (const PredictedReading& one : readings_of_fluid(test, yield_stress_pa).value_or(std::vector<PredictedReading>{}))
    out += (out.empty() ? "" : ", or ") + in_quotes(std::string(one.key)) +
           ": {\"value\": " + shown(rounded(one.value, 3)) +
           ", \"standard_deviation\": " + shown(rounded(one.standard_deviation, 2)) + "} (" + std::string(one.formula) +
           ", with the formula's own error)";
  return out;
}

/// Advice for a laboratory file without readings.
std::string advice_without_readings(const Test& test, std::span<const ReadingKind> kinds,
                                    const std::optional<Measurement>& yield_stress) {
  const auto by_default = std::ranges::find_if(kinds, [](const auto& kind) { return kind.advised && !kind.lack; });
  std::string measure = "give at least one, e.g. " + in_quotes(std::string(by_default->key));
  if (!yield_stress) return measure;
  const std::string predicted = predicted_in_words(test, yield_stress->value);
  if (predicted.empty()) return measure + "; no formula says what its yield stress predicts of this test";
  return measure + "; or what its yield stress predicts, " + predicted +
         ", and say in provenance.notes that it is predicted, not measured";
}

}  // namespace

std::optional<Measurement> read_yield_stress(ObjectReader& material, const Test& test, Questions& questions) {
  if (!readings_of_fluid(test, 1)) {
    material.refuse(yield_stress_kind.key,
                    "no formula compares it with the readings of a " + std::string(kind_of(test)) + " test",
                    "leave it out");
    return std::nullopt;
  }
  Measurement measurement;
  measurement.reading = yield_stress_kind.name;
  const bool there = material.object(
      yield_stress_kind.key, Need::optional,
      [&](ObjectReader& reader) { read_one(reader, yield_stress_kind, measurement, questions); },
      R"({"value": ..., "standard_deviation": ...}, or {"repeats": [...]}, in Pa)");
  return there ? std::optional(measurement) : std::nullopt;
}

std::vector<Measurement> read_measurements(ObjectReader& document, Test& test,
                                           const std::optional<Measurement>& yield_stress, Questions& questions) {
  const auto kinds = reading_kinds(test);
  std::vector<Measurement> measurements;
  if (yield_stress && !document.has("measurements")) {
    document.known("measurements");
    document.fault("measurements", "is missing", advice_without_readings(test, kinds, yield_stress));
    return measurements;
  }
  document.object("measurements", Need::required, [&](ObjectReader& reader) {
    bool any = false;
    for (const ReadingKind& kind : kinds) {
      if (kind.key.empty()) continue;
      any = any || reader.has(kind.key);
      if (kind.lack) {
        reader.refuse(kind.key, std::string(kind.lack->what), std::string(kind.lack->remedy));
        continue;
      }
      Measurement measurement;
      measurement.reading = kind.measure;
      const auto read = [&](ObjectReader& one) {
        if (!kind.from_outline) return read_one(one, kind, measurement, questions);
        std::visit([&](auto& own) { read_outline(one, kind, own); }, test);
        one.number("standard_deviation", measurement.standard_deviation, deviations, Need::required);
      };
      if (!reader.object(kind.key, Need::optional, read, form_of(kind, reader.content(kind.key)))) continue;
      if (kind.on_request) std::visit([&](auto& own) { ask_for(own, kind); }, test);
      if (!measurements.empty() && measurements.back().reading == kind.measure)
        reader.fault(kind.key, std::string(kind.measure) + " and this are one reading", "give one of them");
      if (kind.less_than) measurement.value = *kind.less_than - measurement.value;
      measurements.push_back(std::move(measurement));
    }
    check_orders(document, kinds, measurements);
    bool strange = refuse_strange(reader, test, kinds);
    strange = refuse_times(reader, kinds) || strange;
    if (any || strange) return;
    document.fault("measurements", "holds no reading", advice_without_readings(test, kinds, yield_stress));
  });
  return measurements;
}

namespace {

/// {"value", "standard_deviation"} or {"repeats"}.
ObjectSchema::Json told_measurement(ObjectSchema& schema, const std::string& name, const Range& range) {
  const Key deviation("standard_deviation",
                      "standard deviation of one reading, in its unit; with `repeats`, the larger of this value and "
                      "the standard deviation of the repeats is used");
  const auto single = schema.described([&](ObjectSchema& form) {
    form.number({"value", "a single reading, or the mean of several"}, 0, range, Need::required);
    form.number(deviation, 0, deviations, Need::required);
  });
  const auto several = schema.described([&](ObjectSchema& form) {
    form.numbers({"repeats", "readings of several tests, one number from each"}, {}, range, Need::required, 2);
    form.number(deviation, 0, deviations, Need::optional);
  });
  return schema.defined(name, {{"oneOf", {single, several}}});
}

/// Points of an outline, or of a curve over time.
ObjectSchema::Json told_points(ObjectSchema& schema, bool over_time) {
  constexpr double most_mm = 10000;
  return schema.described([&](ObjectSchema& form) {
    form.shared(over_time ? "spread_curve" : "profile");
    if (over_time)
      form.pairs({"points", "points [time in s, spread in mm], in ascending order of time"}, {}, {0, most_mm},
                 {0, most_mm}, Need::required, 3);
    else
      form.pairs({"points",
                  "points [x, z] in mm, in ascending order of x; x is measured from the centre of the table towards "
                  "the free edge"},
                 {}, {-most_mm, most_mm}, {-most_mm, most_mm}, Need::required, 5);
    form.number({"standard_deviation", over_time ? "standard deviation of a spread, in mm"
                                                 : "standard deviation of a height of the outline, in mm"},
                0, deviations, Need::required);
  });
}

}  // namespace

void tell_yield_stress(ObjectSchema& material) {
  const auto [smallest, largest] = yield_stress_kind.possible;
  material.put({yield_stress_kind.key,
                "yield stress measured with a vane or another rheometer; compared with the readings by a formula, not "
                "fitted; only for tests that have such a formula"},
               told_measurement(material, "yield_stress", {smallest, largest}), Need::optional);
}

void tell_measurements(ObjectSchema& lab) {
  using Json = ObjectSchema::Json;
  constexpr double most = 1e7;
  Json one_of_two = Json::array();
  Json schema = lab.described([&](ObjectSchema& readings) {
    const std::vector<ReadingKind> kinds = all_reading_kinds();
    const ReadingKind* before = nullptr;
    for (const ReadingKind& kind : kinds) {
      if (kind.key.empty()) continue;
      readings.put({kind.key, meaning_of_reading(kind.key)},
                   kind.from_outline            ? told_points(readings, kind.name == "step1.spread_curve_mm")
                   : kind.possible.smallest < 0 ? told_measurement(readings, "signed_reading", {-most, most})
                                                : told_measurement(readings, "reading", {0, most}),
                   Need::optional);
      if (before && before->measure == kind.measure) {
        Json& both = one_of_two.emplace_back()["not"]["required"];
        both.push_back(before->key);
        both.push_back(kind.key);
      }
      before = &kind;
    }
  });
  schema["minProperties"] = 1;
  schema["allOf"] = one_of_two;
  lab.put({"measurements",
           "measured readings, at least one; a number is given as {`value`, `standard_deviation`} or as {`repeats`}"},
          std::move(schema), Need::required);
}

}  // namespace pastefit
