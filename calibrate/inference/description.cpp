#include "calibrate/inference/description.h"

#include <algorithm>
#include <cmath>

#include "calibrate/base/text.h"

namespace pastefit {

namespace {

constexpr double worth_a_word = 0.2;     // component over that of the lead from which a parameter is named
constexpr double worth_measuring = 0.9;  // narrowing above which a measurement is not proposed
constexpr std::size_t most_gains = 3;

/// Parameters that can replace the lead in the best determined combination, with their exchange rates.
std::string exchange_of(const Inference& inference, const Combination& combination) {
  const ParameterInterval& lead = inference.intervals[combination.lead];
  std::vector<std::string> rates;
  for (std::size_t j = 0; j < inference.intervals.size(); ++j) {
    const ParameterInterval& other = inference.intervals[j];
    const double part = combination.direction[j] / combination.direction[combination.lead];
    if (j == combination.lead || std::abs(part) < worth_a_word) continue;
    const double ratio = part * lead.deviation_before / other.deviation_before;
    const auto change = [](const Parameter& parameter, double coordinates) {
      if (parameter.scale == Scale::linear) return format("%+.2g", coordinates * (parameter.upper - parameter.lower));
      return format("%+.0f %%", 100 * std::expm1(coordinates * std::log(parameter.upper / parameter.lower)));
    };
    constexpr double step = 0.1;  // of the range
    rates.push_back(other.parameter.name + " " + change(other.parameter, step) + " acts like " + lead.parameter.name +
                    " " + change(lead.parameter, ratio * step));
  }
  if (rates.empty()) return "";
  return "  Other parameters can compensate for it: " + enumerated(rates) + ".\n";
}

/// "13.2 to 526", marked at an end that is the study's bound.
std::string ends_in_words(const IntervalEnd& lower, const IntervalEnd& upper) {
  const auto words = [](const IntervalEnd& end) {
    return plain(end.at, 4) + (end.known ? "" : " (the study's bound)");
  };
  return words(lower) + " to " + words(upper);
}

/// For one free parameter: there is only one interval.
std::string determined_alone(const Inference& inference) {
  const ParameterInterval& one = inference.intervals.front();
  std::string out;
  if (inference.jumps)
    out += format(
        "  %s jumps with %s: predicted from the other simulations, a simulation is off by more than three standard "
        "deviations. There is no prediction between neighbouring simulations.\n",
        enumerated(inference.fitted), one.parameter.name);
  if (one.parameter.prior || one.not_identified()) return out;
  const std::vector<std::string>& led = inference.combinations.front().readings;
  return out + format("  %s %s %s to the interval %s (95 %%).\n", enumerated(led.empty() ? inference.fitted : led),
                      (led.empty() ? inference.fitted : led).size() > 1 ? "limit" : "limits", one.parameter.name,
                      ends_in_words(one.lower, one.upper));
}

std::string determined(const Inference& inference) {
  if (inference.intervals.size() == 1) return determined_alone(inference);
  if (inference.jumps)
    return format(
        "  %s jumps near the recommended material: predicted from the other simulations, a simulation is off by more "
        "than ten standard deviations. There is no prediction there, and no interval with the other parameters "
        "fixed.\n",
        enumerated(inference.fitted));
  std::string out;
  std::vector<std::size_t> said;
  for (const Combination& combination : inference.combinations) {
    const ParameterInterval& lead = inference.intervals[combination.lead];
    if (!combination.determined() || (said.empty() && !lead.held_exists())) continue;
    if (said.empty()) {
      out +=
          format("  With the other parameters fixed at the recommended values, %s %s %s to the interval %s (95 %%).\n",
                 enumerated(combination.readings), combination.readings.size() > 1 ? "limit" : "limits",
                 lead.parameter.name, ends_in_words(lead.held_lower, lead.held_upper));
      out += exchange_of(inference, combination);
    } else {
      const std::string width = lead.parameter.scale == Scale::linear
                                    ? format("+-%.2g", combination.lead_width)
                                    : format("+-%.0f %%", 100 * combination.lead_width);
      out += format("  A further combination, mainly of %s, is determined to %s by %s.\n", lead.parameter.name, width,
                    enumerated(combination.readings));
    }
    said.push_back(combination.lead);
  }
  if (said.empty())
    out += "  The readings do not narrow any parameter, or any combination of them, much below its bounds.\n";
  return out;
}

/// Contributions of prior and readings to a parameter.
std::string prior_line(const ParameterInterval& one) {
  const std::string known = format("  %s had the prior %s +- %s; ", one.parameter.name,
                                   plain(one.parameter.prior->value), plain(one.parameter.prior->standard_deviation));
  if (one.uncertainty > worth_measuring)
    return known + format("the readings do not narrow it. The 95 %% interval, %s, comes from the prior.\n",
                          ends_in_words(one.lower, one.upper));
  return known +
         format("with the readings, the 95 %% interval is %s, which leaves %.0f %% of the prior's uncertainty.\n",
                ends_in_words(one.lower, one.upper), 100 * one.uncertainty);
}

std::string not_identified_because(const Inference& inference, const ParameterInterval& one) {
  if (inference.intervals.size() == 1) return "the readings do not narrow it below its bounds";
  if (one.any_value_fits()) return "any value within its bounds fits if the others change with it";
  return "the readings do not narrow it below its bounds; materials that fit were found from " +
         plain(one.fitting_lower) + " to " + plain(one.fitting_upper);
}

std::string intervals(const Inference& inference) {
  std::string out;
  std::vector<std::string> any;
  for (const ParameterInterval& one : inference.intervals) {
    if (one.parameter.prior) {
      out += prior_line(one);
    } else if (one.not_identified()) {
      if (inference.intervals.size() > 1 && one.any_value_fits())
        any.push_back(one.parameter.name);
      else
        out += "  " + one.parameter.name + " is not identifiable: " + not_identified_because(inference, one) + ".\n";
    } else if (inference.intervals.size() == 1) {
      continue;
    } else if (one.interval_exists()) {
      out += format("  With all parameters free, %s lies between %s and %s (95 %%).\n", one.parameter.name,
                    plain(one.lower.at), plain(one.upper.at));
    } else {
      out += format(
          "  With all parameters free, %s lies %s %s (95 %%); the study's bound "
          "sets the other end.\n",
          one.parameter.name, one.lower.known ? "above" : "below", plain((one.lower.known ? one.lower : one.upper).at));
    }
  }
  if (any.size() == 1)
    out += "  " + any[0] +
           " is not identifiable from this test: any value within its bounds fits if the others change "
           "with it.\n";
  else if (!any.empty())
    out += "  " + enumerated(any) +
           " are not identifiable from this test: each can take any value within its bounds if "
           "the others change with it.\n";
  return out;
}

/// The unstated conditions and their effects.
std::string conditions(const Inference& inference) {
  std::string out;
  for (const ConditionEffect& one : inference.conditions) {
    std::vector<std::string> moved;
    for (const ConditionEffect::Reading& reading : one.readings)
      moved.push_back(reading.name + " from " + plain(reading.at_lower, 4) + " to " + plain(reading.at_upper, 4));
    out += "  " + one.place + ", " + plain(one.lower) + " to " + plain(one.upper) + ": " +
           (moved.empty() ? "not known, because heaps shear off there" : enumerated(moved)) + ".\n";
  }
  if (out.empty()) return out;
  return "Conditions that the files do not state: readings at half and at twice the assumed value\n" + out +
         "  The intervals include this. State what you know in the laboratory file or the study.\n";
}

/// One column for each material, so that five fit 80 columns.
std::string family(const Inference& inference) {
  std::string out = "Materials expected to fit these readings as well as the first, the recommended one" +
                    (inference.recommended_because.empty() ? "" : ", " + inference.recommended_because) + "\n";
  std::size_t widest = 0;
  for (const ParameterInterval& one : inference.intervals) widest = std::max(widest, one.parameter.name.size());
  for (const std::string& reading : inference.fitted) widest = std::max(widest, reading.size());
  const auto row = [&](const std::string& name, const auto& cell) {
    out += format("  %-*s", static_cast<int>(widest), name);
    for (const EquivalentMaterial& member : inference.family) out += format(" %9s", cell(member));
    out += "\n";
  };
  for (std::size_t k = 0; k < inference.intervals.size(); ++k)
    row(inference.intervals[k].parameter.name,
        [&](const EquivalentMaterial& member) { return plain(member.values[k], 4); });
  for (std::size_t k = 0; k < inference.fitted.size(); ++k)
    row(inference.fitted[k], [&](const EquivalentMaterial& member) { return plain(member.readings[k], 4); });
  row("error [sd]", [](const EquivalentMaterial& member) { return plain(member.distance, 2); });
  row("known from",
      [](const EquivalentMaterial& member) { return std::string(member.simulated ? "simulated" : "predicted"); });
  return out;
}

std::string next(const Inference& inference) {
  std::string out;
  for (std::size_t i = 0; i < std::min(most_gains, inference.gains.size()); ++i) {
    const MeasurementGain& gain = inference.gains[i];
    if (gain.narrowing > worth_measuring) break;
    const bool known = std::ranges::find(inference.fitted, gain.reading) != inference.fitted.end();
    out +=
        format("  %d %smeasurements of %s (+-%s each) would narrow the interval of %s by %.0f %%.\n", gain.measurements,
               known ? "more " : "", gain.reading, plain(gain.deviation), gain.parameter, 100 * (1 - gain.narrowing));
  }
  if (inference.jumps) return "  The response jumps: the gain of a further measurement is not predicted.\n";
  if (out.empty())
    out = "  No further reading of this test would narrow an interval; a test of another kind or apparatus may.\n";
  return out;
}

}  // namespace

std::string enumerated(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i)
    out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return out;
}

std::string what_is_determined(const Inference& inference) {
  return "What the readings determine (" + std::to_string(inference.simulations) + " simulations)\n" +
         determined(inference) + intervals(inference) + conditions(inference) + "What to measure next\n" +
         next(inference);
}

std::string describe(const Inference& inference) {
  return what_is_determined(inference) + family(inference);
}

CardInference card_inference(const Inference& inference) {
  constexpr double told = 0.2;  // correlation below which none is reported
  CardInference out;
  out.method = "likelihood of the readings, sampled over the bounds";
  out.level = 0.95;
  for (std::size_t i = 0; i < inference.intervals.size(); ++i) {
    const ParameterInterval& one = inference.intervals[i];
    const std::string& name = one.parameter.name;
    if (one.not_identified() && !one.parameter.prior)
      out.not_identified.push_back({name, not_identified_because(inference, one)});
    else  // an end at the study's bound keeps its exact value
      out.intervals.push_back({name, one.lower.known ? rounded(one.lower.at, 4) : one.parameter.lower,
                               one.upper.known ? rounded(one.upper.at, 4) : one.parameter.upper});
    for (std::size_t j = 0; j < i; ++j) {
      if (!(std::abs(inference.correlation[i][j]) >= told)) continue;
      const std::string& first = inference.intervals[j].parameter.name;
      auto row = std::ranges::find(out.correlations, first, &CardInference::Correlations::first);
      if (row == out.correlations.end()) row = out.correlations.insert(row, {first, {}});
      row->others.push_back({name, rounded(inference.correlation[i][j], 2)});
    }
  }
  for (ConditionEffect& condition : out.conditions = inference.conditions)
    for (ConditionEffect::Reading& reading : condition.readings) {
      reading.at_lower = rounded(reading.at_lower, 5);
      reading.at_upper = rounded(reading.at_upper, 5);
    }
  if (out.intervals.empty()) out.level = 0;
  return out;
}

std::string warning_before(int parameters, int priors, const std::vector<std::string>& fitted) {
  if (parameters <= static_cast<int>(fitted.size()) + priors) return "";
  const auto readings =
      fitted.size() == 1 ? "1 fitted reading fixes" : std::to_string(fitted.size()) + " fitted readings fix";
  return std::to_string(parameters) + " parameters are free, and " + readings + " at most " +
         std::to_string(fitted.size()) + (fitted.size() == 1 ? " combination" : " combinations") + " of them" +
         (priors > 0 ? ", beside " + std::to_string(priors) + " that are known beforehand" : "") +
         ": many materials will fit. The summary will list some of them.\n";
}

}  // namespace pastefit
