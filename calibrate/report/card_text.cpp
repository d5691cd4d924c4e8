#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/report/summary.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

BoundEnds bounds_in(const Card& card, const CardInference::Interval& interval) {
  const auto& parameters = card.material.parameters;
  const auto found = std::ranges::find(parameters, interval.parameter, &Parameter::name);
  return found == parameters.end() ? BoundEnds{} : ends_at_bounds(interval, *found);
}

std::string inference_lines(const Card& card) {
  const CardInference& inference = card.inference;
  std::string out = "Intervals of the parameters\n";
  if (inference.intervals.empty() && inference.not_identified.empty())
    return out + "  not calculated: other materials may fit the same readings\n";
  if (!inference.intervals.empty())
    out += format("  intervals of %g %% confidence (%s)\n", 100 * inference.level, inference.method.c_str());
  for (const auto& interval : inference.intervals)
    out += format("  %-24s ", interval.parameter.c_str()) +
           interval_in_words(interval.lower, interval.upper, bounds_in(card, interval), 6) + "\n";
  for (const auto& [first, others] : inference.correlations)
    for (const auto& [second, value] : others)
      out += format("  %-24s %14.2f with %s\n", first.c_str(), value, second.c_str());
  for (const auto& unseen : inference.not_identified)
    out += "  " + unseen.parameter + " is not identified: " + unseen.reason + "\n";
  return out;
}

std::string conditions_lines(const Card& card) {
  std::string out;
  for (const auto& test : card.tests) {
    const auto& grains = specimen_of(test.test).grains;
    const bool mono = grains.distribution == SizeDistribution::mono;
    out += (card.interpolated ? "For"
            : test.hold_out   ? "Predicted in"
                              : "Fitted in") +
           (test.name.empty() ? "" : " test " + test.name) + "\n" + conditions_in_words(test.test);
    out += mono ? format("  grains                   radius %g mm\n", 1e3 * grains.radius_m)
                : format("  grains                   radius %g to %g mm\n", 1e3 * grains.smallest_m,
                         1e3 * grains.largest_m);
  }
  return out + "  under other conditions the material is an extrapolation\n";
}

std::string origin_lines(const Card& card) {
  const auto& from = card.provenance;
  std::string out = "From\n";
  for (const auto& test : card.tests) {
    const std::string laboratory = test.name.empty() ? "laboratory" : "laboratory of " + test.name;
    out += format("  %-24s ", laboratory.c_str()) + one_line(test.lab_file + " (" + test.lab_hash) + ")\n";
    if (!test.lab.source.empty()) out += "  its source               " + one_line(test.lab.source) + "\n";
  }
  out += "  study                    " + one_line(from.study_file + " (" + from.study_hash) + ")\n";
  for (const std::string& one : from.settings) out += "    with " + one_line(one) + "\n";
  return out + "  program                  " + one_line(from.program) + "\n";
}

std::string baseline_lines(const Card& card) {
  std::string out = "Baseline of checks\n";
  for (const auto& test : card.tests) {
    const auto& baseline = test.baseline;
    out += "  " + (test.name.empty() ? "" : test.name + ": ");
    if (baseline.runs.empty())
      out += "none: checks use the means and standard deviations of the readings above\n";
    else
      out += format("%zu packings, ", baseline.runs.size()) + baseline.program + ", " + baseline.machine + "\n";
  }
  for (const auto& change : card.rebaselined) {
    out += "  changed: " + one_line(change.why) + "\n";
    for (const auto& moved : change.moved)
      out += format("    %-24s %12.5g -> %.5g\n", moved.reading.c_str(), moved.before, moved.after);
  }
  return out;
}

std::string rescaling_lines(const Card& card) {
  std::string out;
  for (const auto& step : card.rescaled) {
    out += format("Converted from grains of %g mm radius by the scaling rule\n", 1e3 * step.from_radius_m);
    if (step.bias.empty()) out += "  the bias of the readings was not measured\n";
    for (const auto& bias : step.bias)
      out +=
          format("  %-24s %12.5g -> %.5g, bias %+.3g", bias.reading.c_str(), bias.before, bias.after,
                 bias.after - bias.before) +
          (bias.standard_error > 0 || card.confirmation.packings.size() > 1 ? format(" +- %.2g\n", bias.standard_error)
                                                                            : " (one packing, error unknown)\n");
  }
  return out;
}

/// Reason why a material with matching readings is not confirmed; empty if the readings do not match.
std::string doubt_about(const FurtherConfirmation& one) {
  const std::size_t heaps = one.packings.size(), rejected = heaps - static_cast<std::size_t>(one.accepted);
  if (one.meets_laboratory || *one.error > 1) return "";
  if (rejected > 0) return format("; %zu of %zu heaps sheared off", rejected, heaps);
  return format("; %zu packings are too few for a decision (--packings)", heaps);
}

}  // namespace

std::string further_confirmation_text(const FurtherConfirmation& one) {
  std::string out =
      "Simulated in another program: " + one_line(one.program) + (one.test.empty() ? "" : ", test " + one.test) + "\n";
  out += format("  grains of %g mm, %zu packings (%d heaps accepted), ranks: %d, %.3g core s, %.3g s\n",
                1e3 * one.radius_m, one.packings.size(), one.accepted, one.ranks, one.core_s, one.wall_s);
  for (const auto& reading : one.readings)
    out += format("  %-24s %12.5g -> %.5g, bias %+.3g", reading.name.c_str(), reading.card, reading.simulated,
                  reading.bias()) +
           (reading.standard_error ? format(" +- %.2g\n", *reading.standard_error) : " (error unknown)\n");
  if (!one.error) return out;
  return out + "  The material " + (one.meets_laboratory ? "reproduces" : "is not shown to reproduce") +
         format(" the measurement there: largest error %.2f of its tolerance", *one.error) + doubt_about(one) + ".\n";
}

std::string text_of(const Card& card) {
  const std::string unconfirmed = unconfirmed_line(card);
  std::string out = (unconfirmed.empty() ? "" : one_line(unconfirmed) + "\n\n") + summary_of(card);
  for (const auto& part :
       {inference_lines(card), conditions_lines(card), origin_lines(card), baseline_lines(card), rescaling_lines(card)})
    if (!part.empty()) out += "\n" + wrapped(lines_of(part));
  for (const auto& one : card.further_confirmations) out += "\n" + wrapped(further_confirmation_text(one));
  return out;
}

std::vector<Measurement> laboratory_measurements(const CardTest& test) {
  std::vector<Measurement> out;
  for (const CardReading& one : test.readings)
    if (one.measured) out.push_back({one.name, *one.measured, one.standard_deviation, one.repeats});
  return out;
}

std::string remarks_on(const CardTest& test) {
  std::vector<Readings> runs;
  for (const auto& run : test.baseline.runs) runs.push_back(run.readings);
  return remarks_on(test.test, runs);
}

}  // namespace pastefit
