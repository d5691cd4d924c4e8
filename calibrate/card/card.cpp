#include "calibrate/card/card.h"

#include <algorithm>
#include <cmath>

#include "calibrate/base/text.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

std::optional<double> standard_error(const CardReading& reading) {
  if (reading.packings < 2) return std::nullopt;
  return reading.simulated_standard_deviation / std::sqrt(static_cast<double>(reading.packings));
}

std::vector<double> values_of(const Material& material) {
  std::vector<double> values;
  for (const auto& parameter : material.parameters) values.push_back(parameter.value);
  return values;
}

bool has_parameter(const Card& card, std::string_view name) {
  return has_parameter(card.material.contact, name) &&
         std::ranges::any_of(card.tests, [&](const CardTest& test) { return acts_in(test.test, name); });
}

std::string reading_name(const CardTest& test, std::string_view reading) {
  return (test.name.empty() ? "" : test.name + "/") + std::string(reading);
}

std::string heading_of(const CardTest& test) {
  return test.name.empty() ? "" : "Test " + test.name + ": ";
}

ErrorUnit error_unit_of(const Card& card) {
  std::vector<std::pair<std::string_view, double>> fitted;
  for (const auto& test : card.tests) {
    if (test.hold_out) continue;
    for (const auto& one : test.readings)
      if (one.measured && one.weight > 0) fitted.emplace_back(one.name, one.tolerance);
  }
  return error_unit_of(fitted);
}

std::string interpolation_in_words(const Interpolation& interpolation) {
  return "Interpolated, not confirmed: " + interpolation.variable + " " + shown(interpolation.value) + ", " +
         (interpolation.model == "linear" ? "linear" : "Gaussian process") + " between " +
         std::to_string(interpolation.studies.size()) + " materials";
}

std::string title_of(const Card& card) {
  return (card.interpolated ? interpolation_in_words(*card.interpolated) + ": " : "") + card.title;
}

BoundEnds ends_at_bounds(const CardInference::Interval& interval, const Parameter& parameter) {
  if (!parameter.free) return {};
  const auto is_bound = [](double end, double bound) { return end == bound || end == rounded(bound, 4); };
  return {is_bound(interval.lower, parameter.lower), is_bound(interval.upper, parameter.upper)};
}

std::string interval_in_words(double lower, double upper, const BoundEnds& at_bounds, int digits) {
  const auto end = [&](double value, bool bound) {
    return plain(value, digits) + (bound ? " (the study's bound)" : "");
  };
  return end(lower, at_bounds.lower) + " to " + end(upper, at_bounds.upper);
}

}  // namespace pastefit
