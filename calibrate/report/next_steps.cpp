#include <algorithm>
#include <cmath>
#include <optional>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/report/diagnosis.h"
#include "calibrate/search/calibration.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

std::string with_setting(const std::string& path, const std::string& value) {
  return " --set " + shell_word_if_needed(path) + "=" + shell_word_if_needed(value);
}

/// Admissible values of a parameter, and plausible ones if they are known.
Range sensible_range(const Parameter& one) {
  const auto kind = std::ranges::find(parameter_kinds(), one.name, &ParameterKind::name);
  Range out{kind->smallest, kind->largest};
  for (const PlausibleRange& range : plausible_ranges())
    if (range.name == one.name) out = {std::max(out.smallest, range.smallest), std::min(out.largest, range.largest)};
  return out;
}

/// Bound beyond the present one, by half the range or, on a logarithmic scale, a factor of two; nothing if there is no
/// sensible value beyond it.
std::optional<double> wider_bound(const Parameter& one, bool upper) {
  const Range range = sensible_range(one);
  const double bound = upper ? one.upper : one.lower, half = 0.5 * (one.upper - one.lower);
  const double moved =
      one.scale == Scale::logarithmic ? (upper ? 2 * bound : bound / 2) : bound + (upper ? half : -half);
  const double wider = std::clamp(rounded(moved, 2), range.smallest, range.largest);
  const bool beyond = upper ? wider > bound : wider < bound && (one.scale == Scale::linear || wider > 0);
  return beyond ? std::optional(wider) : std::nullopt;
}

const Parameter& fitted_parameter(const Card& card, std::string_view name) {
  return *std::ranges::find(card.material.parameters, name, &Parameter::name);
}

/// Moves every bound in the way that can be moved.
std::optional<NextStep> widen_bounds(const Card& card, const std::string& resume) {
  std::string names, settings;
  for (const AtBound& one : parameters_at_bounds(card)) {
    const auto wider = wider_bound(fitted_parameter(card, one.parameter), one.upper);
    if (!wider) continue;
    names += (names.empty() ? "" : ", ") + one.parameter;
    settings += with_setting("parameters." + one.parameter + (one.upper ? ".upper" : ".lower"), exact(*wider));
  }
  if (names.empty()) return std::nullopt;
  return NextStep{"with wider bounds of " + names, resume + settings};
}

/// Heaps shear off less with little sliding friction, and with rolling friction that the search may choose.
std::optional<NextStep> hold_heaps_together(const Card& card, const std::string& resume) {
  constexpr double little_friction = 0.3;
  const Parameter &sliding = fitted_parameter(card, "friction"), &rolling = fitted_parameter(card, "rolling_friction");
  if (sliding.free && sliding.upper > little_friction && sliding.lower < little_friction)
    return NextStep{"with less sliding friction, which makes heaps shear off less often",
                    resume + with_setting("parameters.friction.upper", exact(little_friction))};
  if (!rolling.free && has_parameter(card, rolling.name)) {
    const Range range = sensible_range(rolling);
    return NextStep{"with free rolling friction, which keeps heaps together",
                    resume + with_setting("parameters.rolling_friction",
                                          "{\"free\": [" + exact(range.smallest) + ", " + exact(range.largest) + "]}")};
  }
  return std::nullopt;
}

NextStep more_packings(const Card& card, const std::string& resume) {
  const std::size_t packings = 2 * std::max<std::size_t>(card.confirmation.packings.size(), 2);
  return {"with more packings in the confirmation",
          resume + with_setting("search.confirmation_packings", std::to_string(packings))};
}

}  // namespace

std::vector<NextStep> next_steps(const Card& card, const std::string& calibrate, std::string_view out) {
  std::vector<NextStep> steps;
  if (card.interpolated || cause_unconfirmed(card).empty()) return steps;
  const std::string resume = calibrate + " --resume";
  const bool stopped = card.search.status == name_of(CalibrationStatus::stopped);
  if (stopped) steps.push_back({"from where it was stopped", resume});
  const Verdict readings = verdict_on_readings(evidence_of(card.tests));
  std::optional<NextStep> first;
  if (card.confirmation.fresh && readings == Verdict::undecided) first = more_packings(card, resume);
  if (!first && readings != Verdict::undecided) first = widen_bounds(card, resume);
  if (!first && card.confirmation.fresh && readings == Verdict::meets) first = hold_heaps_together(card, resume);
  if (first) steps.push_back(std::move(*first));
  if (!stopped && card.search.status != name_of(CalibrationStatus::out_of_reach))
    steps.push_back({"with more simulations", resume + " --budget " + std::to_string(2 * card.search.budget)});
  steps.push_back({"to see every reason for doubt", "pastefit doctor " + shell_word_if_needed(out)});
  return steps;
}

std::vector<NextStep> next_steps_without_card(std::string_view status, const std::string& calibrate,
                                              std::string_view study) {
  if (status == name_of(CalibrationStatus::stopped)) return {{"from where it was stopped", calibrate + " --resume"}};
  return {{"to see why the middle of the bounds fails", "pastefit simulate " + shell_word_if_needed(study)},
          {"with simulations that may take any course",
           calibrate + " --resume" + with_setting("search.end_early", "false")}};
}

std::string in_the_way(const Card& card) {
  std::string out = cause_unconfirmed(card);
  for (const AtBound& one : parameters_at_bounds(card)) out += "; " + at_bound_in_words(one);
  return out;
}

std::string next_step_lines(const std::string& in_the_way, const std::vector<NextStep>& steps) {
  if (steps.empty()) return "";
  std::string out =
      "\n" + (in_the_way.empty() ? "" : wrapped("Not confirmed: " + one_line(in_the_way) + ".\n")) + "Ready to run\n";
  for (const NextStep& step : steps) out += "  " + step.why + ":\n    " + one_line(step.command) + "\n";
  return out;
}

}  // namespace pastefit
